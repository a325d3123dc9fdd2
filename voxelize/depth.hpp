#pragma once

#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// How deep the centre of each cell of `grid`, which voxelize() filled from `mesh`, lies under the
/// surface of all solids together [m]: exact next to the surface, about 0.2 of a cell at most too
/// large deep inside. Takes longer than all of voxelize(), so only those who need it ask.
std::vector<float> measure_depth(const MaterialGrid& grid, const TriangleMesh& mesh);

}  // namespace springlod::voxelize
