#include "render/frames.hpp"

#include <fstream>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/render/golden.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace springlod;
using namespace springlod::render;
using namespace springlod::test;

namespace {

Image gradient(std::uint32_t width, std::uint32_t height) {
  Image image{width, height, {}};
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (const std::uint32_t c : {x * 7, y * 5, x * y})
        image.rgb.push_back(static_cast<std::uint8_t>(c & 0xFFU));
  return image;
}

}  // namespace

TEST_CASE("an image read from a PNG file equals the written one") {
  const TemporaryFolder folder;
  const Image image = gradient(61, 47);
  save_png(image, folder.path() / "new" / "picture.png");  // creates the folder
  const Image back = load_png(folder.path() / "new" / "picture.png");
  CHECK(back.width == 61);
  CHECK(back.height == 47);
  CHECK(back.rgb == image.rgb);
}

TEST_CASE("pictures that cannot be written or read are refused") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(save_png(Image{}, folder.path() / "a.png"), InputError);
  CHECK_THROWS_AS(save_png(Image{2, 2, {1, 2, 3}}, folder.path() / "a.png"), InputError);
  CHECK_THROWS_AS(load_png(folder.path() / "missing.png"), IoError);
  std::ofstream(folder.path() / "text.png") << "this is no picture";
  CHECK_THROWS_AS(load_png(folder.path() / "text.png"), IoError);
  std::ofstream(folder.path() / "file") << "not a folder";
  CHECK_THROWS_AS(save_png(gradient(2, 2), folder.path() / "file" / "a.png"), IoError);
}

TEST_CASE("a damaged PNG file is an error, not a crash") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "a.png";
  save_png(gradient(40, 40), path);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  CHECK_THROWS_AS(load_png(path), IoError);
}

TEST_CASE("frames are numbered with four digits or more") {
  CHECK(frame_path("out", 7) == std::filesystem::path("out/frame_0007.png"));
  CHECK(frame_path("out", 12345) == std::filesystem::path("out/frame_12345.png"));
}

TEST_CASE("the difference of two pictures counts pixels beyond the tolerance") {
  Image a = gradient(10, 10);
  for (std::uint8_t& c : a.rgb) c = 100;
  Image b = a;
  CHECK(difference(a, b).largest == 0);
  b.rgb[0] = 103;
  CHECK(difference(a, b).largest == 3);
  CHECK(difference(a, b).share_beyond == 0);
  b.rgb[31] = 90;
  b.rgb[32] = 60;  // the same pixel
  CHECK(difference(a, b).largest == 40);
  CHECK(difference(a, b).share_beyond == Approx(0.01));
  CHECK_THROWS_AS(difference(a, gradient(5, 20)), InputError);
}
