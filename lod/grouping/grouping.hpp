#pragma once

#include <cstdint>
#include <vector>

#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// Input of a grouping.
struct GroupingTask {
  const MassSpringModel& model;
  const SpringRows& springs;       ///< of the model
  std::uint32_t count;             ///< requested number of groups
  const GroupingOptions& options;  ///< `options.grouping` is not read
};

/// Groups of the nodes by `options.grouping`. The result is reproducible for equal options.
Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options);
/// The same with the spring rows of `model`.
Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options);

/// Groups from `sets` of node numbers; every other node stays single. Throws InputError for a node
/// in two sets or out of range, and for a set that is not connected by springs.
Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets);

/// Groups from `leader`, the first node of each node's group. They are numbered by their lowest
/// node, so coarse nodes keep the order of the fine ones and neighbours stay close in memory.
Groups groups_from_leaders(const std::vector<std::uint32_t>& leader);

}  // namespace springlod::lod
