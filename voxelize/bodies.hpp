#pragma once

#include <vector>

#include "base/disjoint_sets.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The bodies that cells form: sets of cells that share at least a corner. Cells in grid order.
DisjointSets::Numbers bodies_of(const std::vector<CellIndex>& cells);

}  // namespace springlod::voxelize
