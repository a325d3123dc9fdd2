#pragma once

#include <cstdint>
#include <vector>

#include "model/binding.hpp"
#include "model/chain.hpp"
#include "model/vec.hpp"

namespace springlod::lod {

/// A point of the model before, in a group of its nodes.
struct GroupPoint {
  Vec3 rest = Vec3::Zero();  ///< [m]
  std::uint32_t group = 0;
};

/// Weights that interpolate a field on the nodes of a merged model to points of the model before,
/// each from its group's node and that node's spring neighbours (docs/method.md, eq. 26).
Binding points_from_groups(const std::vector<GroupPoint>& points, const MassSpringModel& coarse);

/// The same to the nodes of the model before.
Binding fine_from_coarse(const MassSpringModel& fine, const MassSpringModel& coarse,
                         const Groups& groups);

/// The same from the nodes of level `level` to the base nodes. The map is linear, so it holds for
/// positions and velocities; it is the identity for level 0. Throws InputError for a level that the
/// chain does not have.
Binding base_from_level(const LodChain& chain, std::uint32_t level);

}  // namespace springlod::lod
