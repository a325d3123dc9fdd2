#pragma once

#include <cstdint>

#include "lod/grouping/grouping.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

struct CompactOptions {
  std::uint32_t count = 0;  ///< number of groups
  BorderRule border = BorderRule::none;
  /// Grading of group sizes by stiffness, 0 to 1: stiff materials get larger groups, which
  /// lengthens the stable time step and leaves more nodes to soft ones. 0: equal sizes; 1: equal
  /// highest frequencies. See graded_shares.
  double grading = 0.5;
  std::uint64_t seed = 1;
  /// Passes of Lloyd's iteration; more change little.
  std::uint32_t passes = 25;
};

/// Makes exactly `count` compact groups, of about equal size within a material: recursive bisection
/// across the longest extent, then centroidal Voronoi cells by Lloyd's iteration (Lloyd 1982;
/// docs/method.md, eq. 24 and the text above it), then feed_light_groups. A group is connected by
/// springs and lies within one material and, with BorderRule::weak, within the border or the
/// interior. With BorderRule::strong border nodes stay single.
///
/// The time is N log N. Throws InputError if `count` is less than the number of kinds of nodes that
/// must stay apart, or more than the nodes.
Groups compact_groups(const MassSpringModel& model, const CompactOptions& options);
/// The same with the options of a grouping.
Groups compact_groups(const GroupingTask& task);

}  // namespace springlod::lod
