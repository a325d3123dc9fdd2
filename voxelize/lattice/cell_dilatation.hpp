#pragma once

#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/corner_nodes.hpp"

namespace springlod::voxelize {

/// The dilatation terms of a `corners` lattice: one for each cell whose material has not Poisson's
/// ratio 1/4, T = Lambda a^3, over its eight nodes, b = (+-1, +-1, +-1) / (4 a): F is the mean
/// deformation gradient of the cell (docs/method.md, eq. 8c).
DilatationTerms cell_terms(const MaterialGrid& grid, const CornerNodes& nodes);

}  // namespace springlod::voxelize
