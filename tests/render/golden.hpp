#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include <catch2/catch.hpp>

#include "render/frames.hpp"
#include "tests/support/paths.hpp"

namespace springlod::test {

/// Compares with tests/golden/<name>.png; with SPRINGLOD_BLESS=1 replaces that file. Channels may
/// differ by 3 of 255, and 0.5 % of the pixels (at edges) by more, as llvmpipe's results depend on
/// the processor.
inline void check_golden(const render::Image& picture, const std::string& name) {
  const auto golden = source_folder() / "tests" / "golden" / (name + ".png");
  const char* bless = std::getenv("SPRINGLOD_BLESS");
  if (bless != nullptr && std::string(bless) == "1") {
    render::save_png(picture, golden);
    WARN("blessed " << golden.string());
    return;
  }
  REQUIRE(std::filesystem::exists(golden));
  const render::Image wanted = render::load_png(golden);
  REQUIRE(picture.width == wanted.width);
  REQUIRE(picture.height == wanted.height);
  const render::ImageDifference found = render::difference(picture, wanted);
  const bool same = found.share_beyond <= 0.005;
  if (!same) {
    const auto actual = build_folder() / "golden_failures" / (name + ".png");
    render::save_png(picture, actual);
    FAIL("the picture differs from " << golden.string() << " in " << 100 * found.share_beyond
                                     << " % of its pixels (by up to " << found.largest
                                     << "); it was written to " << actual.string()
                                     << ". If it is right, run again with SPRINGLOD_BLESS=1");
  }
  SUCCEED();
}

}  // namespace springlod::test
