#pragma once

#include <cstdint>
#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Gives nodes of heavier neighbours to light groups: those of less than half the mean mass of the
/// groups of their kind. The lightest nodes limit the stable step of a level, because the squared
/// frequency of a node is its stiffness over its mass; nodes at edges and corners of a lattice
/// have a quarter and an eighth of the mass of those inside (docs/method.md, eq. 24 and the text
/// around it).
///
/// A light group takes, up to three times, the node nearest to its centre of mass of those that
/// springs join to it, unless the group of that node would become lighter than it was itself. No
/// group becomes empty. `kind` of each node, N: nodes of different kinds never share a group.
void feed_light_groups(const MassSpringModel& model, const std::vector<std::uint32_t>& kind,
                       Groups& groups);

}  // namespace springlod::lod
