#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// An order of points in compact blocks of nearly equal size, in which neighbours in space are
/// close together.
struct BlockOrder {
  std::vector<std::uint32_t> point;  ///< place -> point
  std::vector<std::uint32_t> first;  ///< start of each block in the order, and the end
};

/// Recursive bisection at the median of the longest side. Blocks are the first ranges with at most
/// `most` points, sorted along the longest side of the whole body; within a block, bisection
/// continues. The same points give the same order.
BlockOrder order_in_blocks(const std::vector<Vec3>& points, std::uint32_t most);

}  // namespace springlod::sim
