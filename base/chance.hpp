#pragma once

#include <cstdint>

namespace springlod::inline base {

// Chance with the same bits on every machine and standard library: SplitMix64 (Steele, Lea and
// Flood 2014, "Fast splittable pseudorandom number generators", with the constants of Vigna's
// public-domain splitmix64.c). Not for secrets.

/// What the state of SplitMix64 grows by at each number: 2^64 over the golden ratio, made odd.
inline constexpr std::uint64_t kChanceStep = 0x9e3779b97f4a7c15ULL;

/// One step of SplitMix64 from state `z`: 64 bits that depend on `z` alone.
constexpr std::uint64_t mix(std::uint64_t z) {
  z += kChanceStep;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

/// Numbers one after another. Two streams of one seed with different `stream` have nothing to do
/// with each other, so that every piece of a job can have its own, whatever the thread that does
/// it.
class ChanceStream {
 public:
  explicit ChanceStream(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(mix(mix(seed) ^ stream)) {}

  std::uint64_t bits() {
    const std::uint64_t value = mix(state_);
    state_ += kChanceStep;
    return value;
  }

  /// Uniform in [0, 1), all 53 bits of a double.
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

  /// Uniform in 0 .. count - 1, without bias (Lemire 2019); count > 0.
  std::uint32_t below(std::uint32_t count) {
    std::uint64_t product = (bits() >> 32U) * count;
    const std::uint32_t unfair = (0U - count) % count;  // 2^32 mod count
    while (static_cast<std::uint32_t>(product) < unfair) product = (bits() >> 32U) * count;
    return static_cast<std::uint32_t>(product >> 32U);
  }

 private:
  std::uint64_t state_;
};

}  // namespace springlod::inline base
