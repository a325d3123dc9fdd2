#pragma once

#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Depth [m] of the centre of each cell of `grid` under the common surface of all solids;
/// voxelize() made the grid from `mesh`. Exact in cells next to the surface; far from it up to
/// about 0.2 of a cell too large. It takes longer than voxelize(), so it is computed only on
/// request.
std::vector<float> measure_depth(const MaterialGrid& grid, const TriangleMesh& mesh);

}  // namespace springlod::voxelize
