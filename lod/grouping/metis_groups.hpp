#pragma once

#include <cstdint>

#include "lod/grouping/grouping.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Makes `count` connected groups of about equal size by METIS (Karypis & Kumar 1998, multilevel
/// recursive bisection), which minimizes the sum of k L^2 over cut springs. It is a baseline for
/// geometric groupings. Throws InputError if `count` is 0 or exceeds the number of nodes,
/// and always in a build without METIS.
Groups metis_groups(const MassSpringModel& model, std::uint32_t count, std::uint64_t seed);
/// The same with the options of a grouping.
Groups metis_groups(const GroupingTask& task);

}  // namespace springlod::lod
