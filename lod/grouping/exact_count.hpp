#pragma once

#include <cstdint>

#include "lod/grouping/grouping.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// Splits single nodes off the largest groups until there are `count` groups. The node is one whose
/// removal leaves the rest of its group connected. Does nothing if there are `count` groups or more
/// already; throws InputError if `count` exceeds the number of nodes.
void split_to_count(const MassSpringModel& model, const SpringRows& springs, std::uint32_t count,
                    Groups& groups);

/// Fuses the smallest groups with the nearest joined groups until there are `count` groups or no
/// two may be fused. Two groups may be fused if they have the same material, with BorderRule::weak
/// if both or neither have border nodes, with BorderRule::strong if neither has.
void fuse_to_count(const MassSpringModel& model, BorderRule border, std::uint32_t count,
                   Groups& groups);

}  // namespace springlod::lod
