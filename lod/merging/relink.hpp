#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/chain.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {

/// What becomes of springs when their ends go into groups.
struct Relinking {
  static constexpr auto kInside = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> a, b;  ///< joined pairs of groups, a < b, sorted by (a, b), each once
  std::vector<std::uint32_t> into;  ///< spring -> its pair; kInside if its ends are in one group
};

/// Finds the joined pairs; summing up what the springs carry is left to the caller, who goes
/// through `into`. This is the symbolic half of the sparse product P^T A P, row by row (Gustavson
/// 1978): linear in the number of springs, but for the sort of each group's few neighbours.
/// Throws InputError unless `groups` are valid and of the nodes of `springs`.
Relinking relink(const SpringRows& springs, const Groups& groups);

/// `finer` first, then `coarser`, which relinked the pairs of `finer`.
Relinking compose(Relinking finer, Relinking coarser);

}  // namespace springlod::lod
