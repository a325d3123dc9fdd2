#pragma once

#include <cstdint>

#include "model/binding.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Weights that interpolate a field on the nodes of a merged model to those of the model before,
/// each from its group's node and that node's spring neighbours (docs/method.md, eq. 26).
Binding fine_from_coarse(const MassSpringModel& fine, const MassSpringModel& coarse,
                         const Groups& groups);

/// The same from the nodes of level `level` to the base nodes. The map is linear, so it holds for
/// positions and velocities; it is the identity for level 0. Throws InputError for a level that the
/// chain does not have.
Binding base_from_level(const LodChain& chain, std::uint32_t level);

}  // namespace springlod::lod
