#pragma once

#include <vector>

#include "base/disjoint_sets.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The bodies that cells form: sets of cells that share at least a corner. Cells in grid order.
DisjointSets::Numbers bodies_of(const std::vector<CellIndex>& cells);

/// As set_materials() of grid.hpp, for a grid whose bodies_of() are known.
void set_materials(MaterialGrid& grid, const std::vector<MaterialInput>& inputs,
                   const DisjointSets::Numbers& bodies);

}  // namespace springlod::voxelize
