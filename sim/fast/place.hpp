#pragma once

#include <cstdint>

namespace springlod::sim {

/// Location of a node in a layout.
struct Place {
  std::uint32_t block = 0;
  std::uint32_t index = 0;  ///< within the block
};

/// Largest number of nodes in a block. Their data fits into the L2 cache of a core, and large
/// models have enough blocks for all threads.
inline constexpr std::uint32_t kBlockNodes = 4096;

}  // namespace springlod::sim
