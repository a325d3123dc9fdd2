#pragma once

#include <cstdint>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// `count` connected groups of about equal size that cut as little sum k L^2 as METIS finds
/// (Karypis & Kumar 1998, multilevel recursive bisection): graph partitioning as a baseline for
/// groupings that look at places. Throws InputError for a count of 0 or of more than the nodes,
/// and always in a build without METIS.
Groups metis_groups(const MassSpringModel& model, std::uint32_t count, std::uint64_t seed);

}  // namespace springlod::lod
