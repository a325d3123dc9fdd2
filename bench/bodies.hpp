#pragma once

#include <cstdint>

#include "model/mass_spring.hpp"

namespace springlod::bench {

/// A cube of side^3 cells on the `corners` lattice: (side + 1)^3 nodes, resting a little in the
/// floor, so that contact and friction have work.
MassSpringModel lattice_cube(int side);
/// About `nodes` nodes: the first level merged from such a cube.
MassSpringModel merged_cube(std::uint32_t nodes);

}  // namespace springlod::bench
