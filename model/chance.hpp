#pragma once

#include <cstdint>

namespace springlod {

/// Random numbers that depend on nothing but the seed and what is asked (the finalizer of
/// SplitMix64, Steele et al. 2014): the same bits on every machine and in any order of evaluation.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : seed_(mix(seed)) {}
  std::uint64_t bits(std::uint64_t x, std::uint64_t y = 0) const { return mix(mix(seed_ ^ x) ^ y); }
  /// In [0, 1).
  double uniform(std::uint64_t x, std::uint64_t y = 0) const {
    return static_cast<double>(bits(x, y) >> 11) * 0x1p-53;
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  std::uint64_t seed_;
};

}  // namespace springlod
