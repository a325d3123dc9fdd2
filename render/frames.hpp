#pragma once

#include <cstdint>
#include <filesystem>

#include "render/context.hpp"

namespace springlod::render {

/// Writes a PNG (zlib level 1, SUB filter) through write_aside, unsynced: a video has hundreds.
/// Throws IoError.
void save_png(const Image& image, const std::filesystem::path& path);
/// Reads 8-bit PNG as RGB. Throws IoError.
Image load_png(const std::filesystem::path& path);

/// "frame_0007.png"
std::filesystem::path frame_path(const std::filesystem::path& folder, std::uint32_t number);

/// Difference of two images: the largest channel difference [0..255] and the fraction of pixels
/// whose difference exceeds `tolerance`.
struct ImageDifference {
  int largest = 0;
  double share_beyond = 0;
};
ImageDifference difference(const Image& a, const Image& b, int tolerance = 3);

}  // namespace springlod::render
