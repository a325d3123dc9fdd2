#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// An order of points in compact blocks of nearly equal size: neighbours in space are close in it.
struct BlockOrder {
  std::vector<std::uint32_t> point;  ///< place -> point
  std::vector<std::uint32_t> first;  ///< place at which each block begins, and the end
};

/// Halves the points recursively at the median of their longest side. Blocks are the first halves
/// of at most `most` points, sorted along the longest side of the whole; the halving continues
/// within them. The same points give the same order.
BlockOrder order_in_blocks(const std::vector<Vec3>& points, std::uint32_t most);

}  // namespace springlod::sim
