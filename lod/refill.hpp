#pragma once

#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Global rescaling (the paper, section 4.1): a chain whose coarser levels are models of their own,
/// made anew in the volume of the base (refill_levels of voxelize/refill.hpp). No nodes are merged:
/// every node of the base is mapped to the nearest node of a level, and a node that is nearest to
/// none gets its nearest one. What `levels` say of_base is not read. Throws InputError for a level
/// no coarser than the one before.
LodChain refill(const MassSpringModel& base, std::vector<Level> levels);

}  // namespace springlod::lod
