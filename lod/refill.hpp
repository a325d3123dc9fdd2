#pragma once

#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Global rescaling (the paper, section 4.1): a chain whose coarser levels are separate models that
/// fill the volume of the base (refill_levels of voxelize/refill.hpp). No nodes are merged. Every
/// base node is mapped to the nearest node of a level; a level node without base nodes gets the
/// nearest base node of a group with several. `of_base` of `levels` is not read. Throws InputError
/// for a level that is no coarser than the one before.
LodChain refill(const MassSpringModel& base, std::vector<Level> levels);

}  // namespace springlod::lod
