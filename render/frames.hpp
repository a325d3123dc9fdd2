#pragma once

#include <cstdint>
#include <filesystem>

#include "render/context.hpp"

namespace springlod::render {

/// PNG at zlib level 1 with the SUB filter, written aside and renamed. Throws IoError.
void save_png(const Image& image, const std::filesystem::path& path);
/// Reads 8-bit PNG as RGB. Throws IoError.
Image load_png(const std::filesystem::path& path);

/// "frame_0007.png"
std::filesystem::path frame_path(const std::filesystem::path& folder, std::uint32_t number);

/// How far two pictures are apart: largest difference of a channel and the share of pixels beyond
/// `tolerance` (of 255).
struct ImageDifference {
  int largest = 0;
  double share_beyond = 0;
};
ImageDifference difference(const Image& a, const Image& b, int tolerance = 3);

}  // namespace springlod::render
