#pragma once

#include <cstdint>

#include "model/chain.hpp"
#include "sim/contact/contact_skin.hpp"

namespace springlod::sim {

/// The contact points of level `level` (its nodes that have a contact area), bound to the nodes of
/// level `coarse`.
ContactSkin nodes_of_level_as_skin(const LodChain& chain, std::uint32_t level,
                                   std::uint32_t coarse);

/// The model with all spring stiffnesses and damping coefficients times `factor` > 0.
MassSpringModel stiffened(const MassSpringModel& model, double factor);

}  // namespace springlod::sim
