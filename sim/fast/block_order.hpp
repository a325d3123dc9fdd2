#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// Points in compact blocks of nearly equal size, neighbours in space near each other in the order.
struct BlockOrder {
  std::vector<std::uint32_t> point;  ///< place -> point
  std::vector<std::uint32_t> first;  ///< place at which each block begins, and the end
};

/// Halves the points at the median across their longest side, again and again: blocks are the
/// halves of at most `most` points, sorted along the longest side of the whole, and within them the
/// order goes on halving. The same points give the same order.
BlockOrder order_in_blocks(const std::vector<Vec3>& points, std::uint32_t most);

}  // namespace springlod::sim
