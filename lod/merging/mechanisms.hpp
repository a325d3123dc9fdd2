#pragma once

#include <cstdint>

#include "lod/merging/guard.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

struct RegroupedStep {
  Groups groups;
  MassSpringModel merged;  ///< `fine`, merged by them
  std::uint32_t regrouped =
      0;  ///< fine nodes of groups that were taken apart; 0: `groups` are as they were
};

/// Regroups where merging by `step` would make mechanisms that `fine` does not have, such as a
/// slender bar that becomes a chain of single nodes. The groups that fold are taken apart; their
/// nodes are then fused pair by pair, the pair with the least loss of second moment first (Ward
/// 1963), as long as all stars stay rigid (RigidStars), until there are as many groups as before.
/// If no sound step has that number, there are more groups. If none has less than `below` groups,
/// `step` is returned as it was.
RegroupedStep without_mechanisms(const MassSpringModel& fine, const SpringRows& springs,
                                 GuardedGroups step, std::uint32_t below,
                                 const GuardOptions& options);

}  // namespace springlod::lod
