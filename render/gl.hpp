#pragma once

// For render/ only: OpenGL as exported by OSMesa (no loader; GL_GLEXT_PROTOTYPES is set for the
// whole folder) and RAII owners of its objects.
#include <string>
#include <utility>
#include <vector>

#include <GL/gl.h>
#include <GL/glext.h>

namespace springlod::render {

/// Owns one GL object. Its context must be current at destruction.
template <void (*kDelete)(GLuint)>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(GLuint name) : name_(name) {}
  ~GlObject() { reset(); }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    if (this != &other) {
      reset();
      name_ = std::exchange(other.name_, 0);
    }
    return *this;
  }
  GLuint name() const { return name_; }

 private:
  void reset() {
    if (name_ != 0) kDelete(name_);
    name_ = 0;
  }
  GLuint name_ = 0;
};

void delete_buffer(GLuint name);
void delete_vertex_array(GLuint name);
void delete_texture(GLuint name);
void delete_framebuffer(GLuint name);
void delete_program(GLuint name);
void delete_sampler(GLuint name);

using GlBuffer = GlObject<delete_buffer>;
using GlVertexArray = GlObject<delete_vertex_array>;
using GlTexture = GlObject<delete_texture>;
using GlFramebuffer = GlObject<delete_framebuffer>;
using GlProgram = GlObject<delete_program>;
using GlSampler = GlObject<delete_sampler>;

GlBuffer make_buffer();
GlVertexArray make_vertex_array();
GlTexture make_texture();
GlFramebuffer make_framebuffer();
GlSampler make_sampler();
/// Compiles and links; throws Error with the compiler log, which indicates a bug in springlod.
GlProgram make_program(const char* name, const std::string& vertex, const std::string& fragment);

/// Replaces the whole contents of a buffer that changes every frame.
template <typename T>
void upload(GLenum target, const GlBuffer& buffer, const std::vector<T>& data) {
  glBindBuffer(target, buffer.name());
  glBufferData(target, static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(),
               GL_STREAM_DRAW);
}

/// Binds floats `offset`..`offset + count` of records of `stride` floats to attribute `index`,
/// which advances once per vertex, or once per instance if `per_instance`.
void float_attribute(GLuint index, GLint count, std::size_t stride, std::size_t offset,
                     bool per_instance);

}  // namespace springlod::render
