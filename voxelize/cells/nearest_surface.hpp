#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/cells/frame.hpp"

namespace springlod::voxelize {

/// Nearest point of the surface to a cell's centre.
struct NearestPoint {
  Eigen::Vector3f point;    ///< in cells from the centre of cell (0, 0, 0)
  std::uint32_t label = 0;  ///< label of its triangle
};

/// For each of `cells` (in grid order, within the frame) the nearest point of the surface that
/// encloses all of them. Triangles with cells on both sides are skipped, so faces between touching
/// parts do not count. Exact for cells next to an empty one. Others take the nearest of the points
/// of their 26 neighbours (after Danielsson 1980): on a sphere of 256 cells the error is at most
/// 0.21 of a cell. `labels` has one entry for each triangle (at least one); of equally near
/// triangles the first counts.
std::vector<NearestPoint> nearest_surface(const CellFrame& frame,
                                          const std::vector<CellIndex>& cells,
                                          const std::vector<Vec3>& positions,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& labels);

}  // namespace springlod::voxelize
