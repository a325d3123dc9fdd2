#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/frame.hpp"

namespace springlod::voxelize {

/// What is known of the surface nearest to a cell's centre.
struct NearestPoint {
  Eigen::Vector3f point;    ///< on the surface, in cells from the centre of cell (0, 0, 0)
  std::uint32_t label = 0;  ///< of its triangle
};

/// For each of `cells` (in grid order, within the frame) the nearest point of the surface that
/// bounds them all together. Triangles with cells on both sides are passed over, so faces where
/// parts touch do not count. Exact for cells next to an empty one; deeper ones take the nearest of
/// their 26 neighbours' points (after Danielsson 1980), which on a sphere of 256 cells is at most
/// 0.21 of a cell too far. `labels` has one entry a triangle (there is at least one); of two
/// triangles equally near the one listed first counts.
std::vector<NearestPoint> nearest_surface(const CellFrame& frame,
                                          const std::vector<CellIndex>& cells,
                                          const std::vector<Vec3>& positions,
                                          const std::vector<Triangle>& triangles,
                                          const std::vector<std::uint32_t>& labels);

}  // namespace springlod::voxelize
