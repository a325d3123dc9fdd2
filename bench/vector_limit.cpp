#include "bench/vector_limit.hpp"

#include <cstdint>

#include <hwy/targets.h>

namespace springlod::bench {
namespace {

// Highway target bits: better targets have lower bits.
#if HWY_ARCH_X86
constexpr std::int64_t kBetterThanAvx2 = HWY_AVX2 - 1;
#else
constexpr std::int64_t kBetterThanAvx2 = 0;
#endif

}  // namespace

bool has_more_than_avx2() {
  return (hwy::SupportedTargets() & HWY_TARGETS & kBetterThanAvx2) != 0;
}

VectorLimit::VectorLimit(Vectors vectors) {
  hwy::DisableTargets(vectors == Vectors::avx2 ? kBetterThanAvx2 : 0);
}

VectorLimit::~VectorLimit() {
  hwy::DisableTargets(0);
}

}  // namespace springlod::bench
