#pragma once

namespace springlod::sim {

/// Vector instruction set of the kernels on this processor: "AVX3", "AVX2", ...
const char* vector_target();

/// Whether the kernels round the sum of a product once, with fused multiply-add, as AVX2 and newer
/// sets do. Steps have the same bits on all sets that do, and on all that do not.
bool fuses_products();

/// Limits the kernels of this process to those of SSE4, which every processor of today has: the
/// same bits on all of them. Steps then take two to three times as long.
void use_portable_kernels();

}  // namespace springlod::sim
