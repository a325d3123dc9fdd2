#pragma once

#include <cstdint>

namespace springlod::sim {

/// Where a layout keeps a node.
struct Place {
  std::uint32_t block = 0;
  std::uint32_t index = 0;  ///< within the block
};

/// Nodes of a block at most: what a step touches of them stays in a core's second cache, and blocks
/// are enough for the threads of models that are worth them.
inline constexpr std::uint32_t kBlockNodes = 4096;

}  // namespace springlod::sim
