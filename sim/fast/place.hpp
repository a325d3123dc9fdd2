#pragma once

#include <cstdint>

namespace springlod::sim {

/// Position of a node in a layout.
struct Place {
  std::uint32_t block = 0;
  std::uint32_t index = 0;  ///< within the block
};

/// Largest number of nodes of a block. Its data then stay in the second-level cache of a core, and
/// models large enough for several threads have enough blocks.
inline constexpr std::uint32_t kBlockNodes = 4096;

}  // namespace springlod::sim
