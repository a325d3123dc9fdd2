#pragma once

#include <cstdint>
#include <vector>

#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// What a maker of groups is given.
struct GroupingTask {
  const MassSpringModel& model;
  const SpringRows& springs;       ///< of the model
  std::uint32_t count;             ///< groups wanted
  const GroupingOptions& options;  ///< the grouping itself is the maker's own
};

/// Groups of the maker that `options` name. Same options, same bits.
Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options);
/// The same for whom has the rows of its springs at hand.
Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options);

/// Groups named by hand: `sets` of node numbers; every other node stays single. Throws InputError:
/// a node in two sets or out of range, a set that springs do not hold together.
Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets);

/// Groups from the first node of each node's group, numbered by their lowest node: coarse nodes
/// keep the order of the fine ones, which keeps neighbours near in memory.
Groups groups_from_leaders(const std::vector<std::uint32_t>& leader);

}  // namespace springlod::lod
