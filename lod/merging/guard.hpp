#pragma once

#include <cstdint>

#include "lod/merging/relink.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

struct GuardedGroups {
  Groups groups;
  Relinking links;  ///< relinking of the fine springs by `groups`
};

/// Fuses groups until the merged model has neither coincident centroids nor floppy nodes
/// (docs/method.md, eqs. 20 and 21). A connected component without a sound node before merging (a
/// rope, a cloth) may stay floppy. A component of at most 4 nodes is sound when all its pairs are
/// joined. The rule looks at single nodes; zero_modes checks whole components.
GuardedGroups guard_groups(const MassSpringModel& fine, const Groups& groups,
                           const GuardOptions& options);
/// The same with the spring rows of `fine`.
GuardedGroups guard_groups(const MassSpringModel& fine, const SpringRows& springs,
                           const Groups& groups, const GuardOptions& options);

}  // namespace springlod::lod
