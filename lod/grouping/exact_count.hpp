#pragma once

#include <cstdint>

#include "lod/grouping/grouping.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// Takes single nodes out of the largest groups until there are `count` of them: always one far
/// from where the group's springs meet, so that the rest of the group still holds together.
/// Does nothing if there are as many already; throws InputError for more than the nodes.
void split_to_count(const MassSpringModel& model, const SpringRows& springs, std::uint32_t count,
                    Groups& groups);

/// The other way: fuses the smallest groups with the nearest joined ones until there are `count`,
/// or no two may be fused any more: groups of one material, with BorderRule::weak of one kind of
/// nodes, with BorderRule::strong only inner ones.
void fuse_to_count(const MassSpringModel& model, BorderRule border, std::uint32_t count,
                   Groups& groups);

}  // namespace springlod::lod
