#pragma once

#include <cstdint>

#include "lod/grouping/grouping.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

struct CompactOptions {
  std::uint32_t count = 0;  ///< groups wanted
  BorderRule border = BorderRule::none;
  /// By how much stiff materials get larger groups than soft ones, for a longer step and more nodes
  /// where they are missed: 0 not at all, 1 until they swing alike; see graded_shares.
  double grading = 0.5;
  std::uint64_t seed = 1;
  /// Of Lloyd's iteration; a few more change little.
  std::uint32_t passes = 25;
};

/// Exactly `count` round groups, within a material of about equal size: the nodes are halved again
/// and again across their longest extent until each piece is one group, and centroidal Voronoi
/// cells relaxed from there (Lloyd 1982). A group never crosses from one material to another, nor,
/// with BorderRule::weak, between border and inside; strong borders stay single. It holds together
/// by springs.
///
/// Linear in the nodes but for a logarithm. Throws InputError if `count` is less than the pieces
/// that must stay apart, or more than the nodes.
Groups compact_groups(const MassSpringModel& model, const CompactOptions& options);
/// The same as a grouping.
Groups compact_groups(const GroupingTask& task);

}  // namespace springlod::lod
