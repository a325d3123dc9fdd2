#pragma once

#include <array>
#include <cstdint>

#include "model/mesh.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// A box of cells (0, 0, 0) .. size - 1 in space.
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
  /// Where a point lies, in cells, with the centre of cell (0, 0, 0) at 0.
  Vec3 to_index(const Vec3& point) const { return (point - origin) / cell - Vec3::Constant(0.5); }
};

/// Cells laid around the middle of a bounding box: along each axis the whole number of them that is
/// nearest to its length, so that a box of n cells gives n cells and no face of the box runs
/// through cell centres. Throws InputError: a flat or empty box, a cell that is no length
/// or longer than twice the box, a box too far from the origin for its size, too many cells (says
/// the smallest cell that does).
CellFrame frame_around(const Box3& box, double cell);

}  // namespace springlod::voxelize
