#pragma once

namespace springlod::sim {

/// Vector instruction set of the kernels on this processor: "AVX3", "AVX2", ...
const char* vector_target();

}  // namespace springlod::sim
