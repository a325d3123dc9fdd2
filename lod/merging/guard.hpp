#pragma once

#include <cstdint>

#include "base/option.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/relink.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod {

struct GuardOptions {
  /// Joined groups nearer than this part of the fine model's mean spring length are fused
  /// (coincident centroids would give k = infinity). Spec 3.
  double coincident_fraction = 0.25;
  /// A node with fewer springs is floppy and is fused with its nearest neighbour.
  std::uint32_t least_springs = 4;
  /// A node is floppy too if lambda_min / lambda_max of sum k u u^T is below this: its springs lie
  /// nearly in one plane.
  double least_rigidity = 1e-3;
  BorderRule border = BorderRule::none;  ///< strong: only inner nodes are fused
};
constexpr auto option_rows(const GuardOptions*) {
  return std::tuple(
      option("coincident_fraction", &GuardOptions::coincident_fraction,
             "joined nodes nearer than this part of the mean spring length are fused"),
      option("least_springs", &GuardOptions::least_springs, "a node with fewer springs is floppy"),
      option("least_rigidity", &GuardOptions::least_rigidity,
             "a node is floppy if lambda_min / lambda_max of its springs' sum k u u^T is below"));
}

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

}  // namespace springlod
