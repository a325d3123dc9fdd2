#pragma once

#include <array>
#include <cstdint>

#include "model/mesh.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// A box of cells with the indices (0, 0, 0) .. size - 1.
struct CellFrame {
  double cell = 0;             ///< [m]
  Vec3 origin = Vec3::Zero();  ///< low corner of cell (0, 0, 0) [m]
  CellIndex size{};

  std::uint32_t count() const {
    return static_cast<std::uint32_t>(size[0]) * static_cast<std::uint32_t>(size[1]) *
           static_cast<std::uint32_t>(size[2]);
  }
  /// Number of a cell of the box in the order (z, y, x).
  std::uint32_t number(const CellIndex& c) const {
    return static_cast<std::uint32_t>((c[2] * size[1] + c[1]) * size[0] + c[0]);
  }
  CellIndex index(std::uint32_t number) const {
    const auto nx = static_cast<std::uint32_t>(size[0]);
    const auto ny = static_cast<std::uint32_t>(size[1]);
    return {static_cast<std::int32_t>(number % nx), static_cast<std::int32_t>(number / nx % ny),
            static_cast<std::int32_t>(number / nx / ny)};
  }
  bool contains(const CellIndex& c) const {
    return c[0] >= 0 && c[1] >= 0 && c[2] >= 0 && c[0] < size[0] && c[1] < size[1] &&
           c[2] < size[2];
  }
  Vec3 center(const CellIndex& c) const {
    return origin + cell * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5);
  }
  /// Position of a point in units of cells; the centre of cell (0, 0, 0) is at 0.
  Vec3 to_index(const Vec3& point) const { return (point - origin) / cell - Vec3::Constant(0.5); }
};

/// A frame of cells centred on a bounding box. The number of cells along each axis is its length /
/// cell, rounded, so a box of n cells has exactly n cells and no face of it passes through cell
/// centres. Throws InputError: a flat or empty box, a cell that is not a length above 0 or is more
/// than twice as long as the box, a box too far from the origin for its size, too many cells (the
/// message has the smallest possible cell).
CellFrame frame_around(const Box3& box, double cell);

/// The frame with one more cell on each side.
CellFrame padded(const CellFrame& frame);

}  // namespace springlod::voxelize
