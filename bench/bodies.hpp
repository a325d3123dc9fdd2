#pragma once

#include <cstdint>

#include "model/mass_spring.hpp"

namespace springlod::bench {

/// A cube of side^3 cells on the `corners` lattice: (side + 1)^3 nodes. It slightly penetrates the
/// floor, so that contact and friction are active.
MassSpringModel lattice_cube(int side);
/// The first level of such a cube, with about `nodes` nodes.
MassSpringModel merged_cube(std::uint32_t nodes);

}  // namespace springlod::bench
