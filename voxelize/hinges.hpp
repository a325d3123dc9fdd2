#pragma once

#include <cstdint>
#include <vector>

#include "voxelize/corner_nodes.hpp"
#include "voxelize/lattice.hpp"

namespace springlod::voxelize {

/// Places where filled cells touch only along an edge or at a corner, by the cells around them
/// alone. An edge is a hinge if of its four cells two opposite ones are filled and the two are not
/// joined through faces around one of its ends; a corner is one if its cells fall into several
/// bunches that neither faces nor edges at it join. By node, corner before edges along x, y, z.
std::vector<Hinge> find_hinges(const MaterialGrid& grid, const CornerNodes& nodes);

/// Fills cells until no hinge is left. Each takes the material that most of its face neighbours
/// have and depth 0. Returns how many were filled.
std::uint32_t fill_hinges(MaterialGrid& grid);

}  // namespace springlod::voxelize
