#include "render/frames.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>

#include <fmt/format.h>
#include <png.h>

#include "base/error.hpp"
#include "base/file.hpp"

namespace springlod::render {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// libpng requires that its error callback does not return; the owner below cleans up on the throw.
[[noreturn]] void png_failed(png_structp png, png_const_charp message) {
  const auto* path = static_cast<const fs::path*>(png_get_error_ptr(png));
  throw IoError(fmt::format("cannot write {}: {}", path->string(), message));
}
void png_warned(png_structp, png_const_charp) {}

struct Writer {
  png_structp png;
  png_infop info = nullptr;
  explicit Writer(const fs::path& path)
      : png(png_create_write_struct(PNG_LIBPNG_VER_STRING, const_cast<fs::path*>(&path), png_failed,
                                    png_warned)) {
    info = png_create_info_struct(png);
  }
  ~Writer() { png_destroy_write_struct(&png, &info); }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
};

// `path` is the name in messages.
void write_png(const Image& image, const fs::path& aside, const fs::path& path) {
  File file(std::fopen(aside.c_str(), "wb"));
  if (!file) throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
  {
    const Writer writer(path);
    png_init_io(writer.png, file.get());
    // Level 1 with the SUB filter is 5 times faster than zlib's default; files are about 10 %
    // larger.
    png_set_compression_level(writer.png, 1);
    png_set_filter(writer.png, 0, PNG_FILTER_SUB);
    png_set_IHDR(writer.png, writer.info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(writer.png, writer.info);
    const std::size_t row = std::size_t{3} * image.width;
    for (std::size_t y = 0; y < image.height; ++y)
      png_write_row(writer.png, image.rgb.data() + y * row);
    png_write_end(writer.png, writer.info);
  }
  if (std::fflush(file.get()) != 0)
    throw IoError(fmt::format("cannot write {}: {}", path.string(), std::strerror(errno)));
}

}  // namespace

void save_png(const Image& image, const fs::path& path) {
  if (image.width == 0 || image.height == 0 ||
      image.rgb.size() != std::size_t{3} * image.width * image.height)
    throw InputError(
        fmt::format("{}: the picture is empty or its size does not fit its pixels", path.string()));
  write_aside(
      path, [&](const fs::path& aside) { write_png(image, aside, path); }, Durability::unsynced);
}

Image load_png(const fs::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const auto fail = [&] {
    const std::string message = png.message;
    png_image_free(&png);
    throw IoError(fmt::format("cannot read {}: {}", path.string(), message));
  };
  if (png_image_begin_read_from_file(&png, path.c_str()) == 0) fail();
  png.format = PNG_FORMAT_RGB;
  Image image{png.width, png.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  const png_color background{255, 255, 255};
  if (png_image_finish_read(&png, &background, image.rgb.data(), 0, nullptr) == 0) fail();
  return image;
}

fs::path frame_path(const fs::path& folder, std::uint32_t number) {
  return folder / fmt::format("frame_{:04}.png", number);
}

ImageDifference difference(const Image& a, const Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height)
    throw InputError(fmt::format("pictures of {} x {} and {} x {} pixels cannot be compared",
                                 a.width, a.height, b.width, b.height));
  ImageDifference result;
  std::size_t beyond = 0;
  for (std::size_t p = 0; p < a.rgb.size(); p += 3) {
    int worst = 0;
    for (std::size_t c = p; c < p + 3; ++c)
      worst = std::max(worst, std::abs(int{a.rgb[c]} - int{b.rgb[c]}));
    result.largest = std::max(result.largest, worst);
    beyond += worst > tolerance ? 1 : 0;
  }
  if (!a.rgb.empty())
    result.share_beyond = static_cast<double>(beyond) / (static_cast<double>(a.rgb.size()) / 3);
  return result;
}

}  // namespace springlod::render
