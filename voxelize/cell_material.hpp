#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "voxelize/grid.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {

/// The most frequent material of `cells` (a few numbers; kNoIndex is skipped); in a tie, the lowest
/// number. At least one cell must exist.
inline std::uint16_t commonest_material(const MaterialGrid& grid,
                                        std::span<const std::uint32_t> cells) {
  std::uint16_t best = 0;
  std::ptrdiff_t best_count = 0;
  for (const std::uint32_t cell : cells) {
    if (cell == kNoIndex) continue;
    const std::uint16_t number = grid.material[cell];
    const auto count = std::count_if(cells.begin(), cells.end(), [&](std::uint32_t other) {
      return other != kNoIndex && grid.material[other] == number;
    });
    if (count > best_count || (count == best_count && number < best)) {
      best = number;
      best_count = count;
    }
  }
  return best;
}

}  // namespace springlod::voxelize
