#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The cells of one solid that form plates and rods one cell thick. The corners of such a lattice
/// lie in two layers or four rows, so it bends far too easily.
struct Sliver {
  std::uint16_t solid = 0;
  std::uint64_t cells = 0;
  double thickness = 0;  ///< of the mesh there [m]: median, or the cell if it cannot be measured
};

/// The slivers of a grid, by ascending solid: cells that are in no filled block of 2 x 2 x 2 cells
/// and have no face neighbour that is. Single cells and ridges on the surface of a thicker body are
/// thus none. `cells` in grid order, `solid_of` each; `distance` is the level set of all of them,
/// `cell` their edge [m].
std::vector<Sliver> find_slivers(const std::vector<CellIndex>& cells,
                                 const std::vector<std::uint16_t>& solid_of,
                                 const DistanceField& distance, double cell);

}  // namespace springlod::voxelize
