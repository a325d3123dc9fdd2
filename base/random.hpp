#pragma once

#include <cstdint>

namespace springlod::inline base {

// A random generator with the same bits on every machine and standard library: SplitMix64 (Steele,
// Lea and Flood 2014, "Fast splittable pseudorandom number generators", with the constants of
// Vigna's public-domain splitmix64.c). It is not cryptographic.

/// Increment of the state of SplitMix64 for each number: 2^64 over the golden ratio, rounded to an
/// odd number.
inline constexpr std::uint64_t kSplitMixIncrement = 0x9e3779b97f4a7c15ULL;

/// One step of SplitMix64: 64 random bits that depend on the state `z` alone.
constexpr std::uint64_t split_mix(std::uint64_t z) {
  z += kSplitMixIncrement;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

/// A stream of random numbers. Streams of one seed with different numbers `stream` are independent,
/// so each job of a parallel loop can have its own, whichever thread runs it.
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed, std::uint64_t stream = 0)
      : state_(split_mix(split_mix(seed) ^ stream)) {}

  std::uint64_t bits() {
    const std::uint64_t value = split_mix(state_);
    state_ += kSplitMixIncrement;
    return value;
  }

  /// Uniform in [0, 1), with all 53 bits of a double.
  double unit() { return static_cast<double>(bits() >> 11U) * 0x1p-53; }

  /// Uniform in 0 .. count - 1 without bias (Lemire 2019, "Fast random integer generation in an
  /// interval"); count > 0.
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
