#pragma once

#include <cstdint>
#include <vector>

#include "voxelize/lattice/corner_nodes.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::voxelize {

/// Places where filled cells touch only along an edge or at a corner. An edge is a hinge if exactly
/// two of its four cells are filled, these are opposite, and at one of its ends no sequence of
/// faces connects them. A corner is a hinge if neither faces nor edges at it connect all of its
/// cells. Sorted by node, the corner before the edges along x, y, z.
std::vector<Hinge> find_hinges(const MaterialGrid& grid, const CornerNodes& nodes);

/// Fills cells until no hinge is left. A new cell gets the most frequent material of its face
/// neighbours, and the depth 0. Returns the number of new cells.
std::uint32_t fill_hinges(MaterialGrid& grid);

}  // namespace springlod::voxelize
