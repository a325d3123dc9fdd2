#pragma once

#include <string_view>

namespace springlod::voxelize {

/// Memory for a lattice and for what builds it, per node [bytes]: a node inside has 9 springs of 32
/// bytes and 8 corners of 24, and growing lists have spare room. Blocks and needles of 5e5 to 5e6
/// nodes take 750 to 800.
inline constexpr double kLatticeBytesPerNode = 900;

/// Throws InputError, with a cell that fits, if `cells` cells of edge `cell` [m] need more memory
/// than there is. `bytes`: of each; `stage`: "voxelize".
void require_memory_of_cells(std::string_view stage, double cells, double bytes, double cell);

}  // namespace springlod::voxelize
