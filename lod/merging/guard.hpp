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
  Relinking links;                     ///< of the fine springs by `groups`
  std::uint32_t fused_coincident = 0;  ///< fusions of near centroids
  std::uint32_t fused_floppy = 0;      ///< fusions of floppy nodes
};

/// Fuses groups until the merged model has neither coincident centroids nor floppy nodes. Parts
/// that had no sound node before merging (a rope, a cloth) may stay floppy; a part of at most 4
/// nodes is sound when all its pairs are joined. The rule is local: see zero_modes for the check of
/// a whole part.
GuardedGroups guard_groups(const MassSpringModel& fine, const Groups& groups,
                           const GuardOptions& options);
/// The same for whom has the rows of its springs at hand.
GuardedGroups guard_groups(const MassSpringModel& fine, const SpringRows& springs,
                           const Groups& groups, const GuardOptions& options);

}  // namespace springlod::lod
