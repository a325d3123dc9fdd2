#include "render/context.hpp"

#include <array>
#include <cstddef>
#include <mutex>

#include <GL/osmesa.h>
#include <fmt/format.h>

#include "base/error.hpp"
#include "render/gl.hpp"

namespace springlod::render {
namespace {

/// Largest side of OSMesa [px]; beyond it OSMesaMakeCurrent succeeds but drawing is wrong.
constexpr std::uint32_t kLargestSide = 16384;
constexpr GLsizei kSamples = 4;      // maximum of llvmpipe
constexpr GLsizei kWindowSide = 16;  // OSMesa needs a window buffer, which is not drawn to

// OSMesa keeps lists of its own for all contexts, which it does not lock: contexts are made, made
// current and destroyed by one thread at a time. Drawing needs no lock.
std::mutex& osmesa_lists() {
  static std::mutex lists;
  return lists;
}

void require_side(std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0 || width > kLargestSide || height > kLargestSide)
    throw InputError(
        fmt::format("picture: {} x {} pixels cannot be drawn; each side must be 1 to {}", width,
                    height, kLargestSide));
}

}  // namespace

struct OffscreenContext::Impl {
  GLsizei width;
  GLsizei height;
  OSMesaContext context = nullptr;
  std::array<std::uint8_t, std::size_t{4} * kWindowSide * kWindowSide> window{};
  GLuint multisampled = 0;  // framebuffers
  GLuint resolved = 0;
  std::vector<std::uint8_t> pixels;  // as read back: RGBA, bottom row first

  Impl(std::uint32_t w, std::uint32_t h)
      : width(static_cast<GLsizei>(w)), height(static_cast<GLsizei>(h)) {}
  // Destroying the context frees its framebuffers.
  ~Impl() {
    if (context == nullptr) return;
    const std::lock_guard lock(osmesa_lists());
    OSMesaDestroyContext(context);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  void open() {
    const std::array<int, 11> attributes{OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_PROFILE,
                                         OSMESA_CORE_PROFILE,
                                         OSMESA_CONTEXT_MAJOR_VERSION,
                                         3,
                                         OSMESA_CONTEXT_MINOR_VERSION,
                                         3,
                                         OSMESA_DEPTH_BITS,
                                         0,
                                         0};
    {
      const std::lock_guard lock(osmesa_lists());
      context = OSMesaCreateContextAttribs(attributes.data(), nullptr);
    }
    if (context == nullptr)
      throw Error("OSMesa cannot create an OpenGL 3.3 core context; is libosmesa6 22 installed?");
    make_current();
    make_targets();
  }

  void make_current() {
    if (OSMesaGetCurrentContext() == context) return;
    const std::lock_guard lock(osmesa_lists());
    if (OSMesaMakeCurrent(context, window.data(), GL_UNSIGNED_BYTE, kWindowSide, kWindowSide) ==
        GL_FALSE)
      throw Error("OSMesa cannot make its context current");
  }

  void attach(GLenum attachment, GLenum format, GLsizei samples) const {
    GLuint storage = 0;
    glGenRenderbuffers(1, &storage);
    glBindRenderbuffer(GL_RENDERBUFFER, storage);
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, storage);
  }

  void make_targets() {
    glGenFramebuffers(1, &multisampled);
    glBindFramebuffer(GL_FRAMEBUFFER, multisampled);
    attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, kSamples);
    attach(GL_DEPTH_STENCIL_ATTACHMENT, GL_DEPTH24_STENCIL8, kSamples);
    const bool drawn_ok = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    glGenFramebuffers(1, &resolved);
    glBindFramebuffer(GL_FRAMEBUFFER, resolved);
    attach(GL_COLOR_ATTACHMENT0, GL_RGBA8, 0);
    const bool read_ok = glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
    if (!drawn_ok || !read_ok || glGetError() != GL_NO_ERROR)
      throw InputError(fmt::format(
          "picture: not enough memory for {} x {} pixels; reduce width or height", width, height));
  }
};

OffscreenContext::OffscreenContext(std::uint32_t width, std::uint32_t height) {
  require_side(width, height);
  impl_ = std::make_unique<Impl>(width, height);
  impl_->open();
}

OffscreenContext::~OffscreenContext() = default;

std::uint32_t OffscreenContext::width() const {
  return static_cast<std::uint32_t>(impl_->width);
}
std::uint32_t OffscreenContext::height() const {
  return static_cast<std::uint32_t>(impl_->height);
}

void OffscreenContext::begin() {
  impl_->make_current();
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->multisampled);
  glViewport(0, 0, impl_->width, impl_->height);
}

Image OffscreenContext::finish() {
  Impl& im = *impl_;
  im.make_current();
  glBindFramebuffer(GL_READ_FRAMEBUFFER, im.multisampled);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, im.resolved);
  glBlitFramebuffer(0, 0, im.width, im.height, 0, 0, im.width, im.height, GL_COLOR_BUFFER_BIT,
                    GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, im.resolved);
  const std::size_t w = width();
  const std::size_t h = height();
  im.pixels.resize(w * h * 4);
  // Mesa copies RGBA directly; reading RGB is several times slower.
  glReadPixels(0, 0, im.width, im.height, GL_RGBA, GL_UNSIGNED_BYTE, im.pixels.data());
  Image image{width(), height(), std::vector<std::uint8_t>(w * h * 3)};
  std::uint8_t* out = image.rgb.data();
  for (std::size_t y = h; y-- > 0;) {
    const std::uint8_t* in = im.pixels.data() + y * w * 4;
    for (std::size_t x = 0; x < w; ++x, in += 4, out += 3) {
      out[0] = in[0];
      out[1] = in[1];
      out[2] = in[2];
    }
  }
  return image;
}

}  // namespace springlod::render
