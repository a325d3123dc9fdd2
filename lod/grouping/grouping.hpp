#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// Puts nodes that are joined by springs into groups of 2 or 3 (each drawn with probability 1/2);
/// what is left over stays single. Same options, same bits.
Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options);
/// The same for whom has the rows of its springs at hand.
Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options);

/// Groups named by hand: `sets` of node numbers; every other node stays single. Throws InputError:
/// a node in two sets or out of range, a set that springs do not hold together.
Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets);

}  // namespace springlod::lod
