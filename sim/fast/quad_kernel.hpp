#pragma once

#include "sim/fast/quad_layout.hpp"

namespace springlod {

/// Adds k (l - L) + c dl/dt along each spring of the block to `forces` at both ends, after the
/// halo's records have been brought up to date. Picks the widest vectors that the processor has;
/// the sums come in the same order with any of them, but not with the same rounding.
void add_block_forces(SpringBlock<float>& block);
void add_block_forces(SpringBlock<double>& block);

/// "AVX3", "AVX2", ...: what add_block_forces runs on here.
const char* vector_target();

}  // namespace springlod
