#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/binding.hpp"
#include "model/vec.hpp"

namespace springlod::report {

// Arrays as base64 of little-endian numbers, which a page turns into typed arrays.

/// Whole numbers with as many bytes as the largest needs.
struct PackedWhole {
  std::string type = "u8";  ///< "u8", "u16" or "u32"
  std::string data;         ///< base64
};
PackedWhole pack(const std::vector<std::uint32_t>& values);

/// Positions of all frames, each coordinate in 16 bits: x = low + size / 65535 * number. Rounding
/// moves a position by at most size / 131070 along each axis.
struct PackedPositions {
  Vec3 low = Vec3::Zero();  ///< lowest corner of their box [m]
  double size = 0;          ///< largest edge of the box [m]
  std::string data;         ///< base64 of u16: by frame, node, axis
};
PackedPositions pack(const std::vector<std::vector<Vec3>>& frames);

/// The rows of a Binding; weights are i16 / 32767 * scale, of which the reader makes the sum 1.
/// Weights that round to 0 are left out.
struct PackedRows {
  PackedWhole count;   ///< entries of each row
  PackedWhole node;    ///< of each entry
  double scale = 1;    ///< largest |weight|
  std::string weight;  ///< base64 of i16
};
PackedRows pack(const Binding& rows);

}  // namespace springlod::report
