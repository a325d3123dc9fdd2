#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/chain.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// The springs of a merged model and the map of the fine springs to them.
struct Relinking {
  static constexpr auto kInside = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> a, b;  ///< joined pairs of groups, a < b, sorted by (a, b), each once
  std::vector<std::uint32_t> into;  ///< fine spring -> pair; kInside if its ends are in one group
};

/// Finds the joined pairs of groups; the caller sums stiffnesses by `into`. This is the symbolic
/// phase of the sparse product P^T A P, row by row (Gustavson 1978). The time is linear in the
/// number of springs, apart from the sort of each group's few neighbours. Throws InputError unless
/// `groups` are valid and map the nodes of `springs`.
Relinking relink(const SpringRows& springs, const Groups& groups);

/// The composition of `finer` and `coarser`, where `coarser` relinked the pairs of `finer`.
Relinking compose(Relinking finer, Relinking coarser);

}  // namespace springlod::lod
