#include "base/random.hpp"

#include <array>
#include <cmath>

#include <catch2/catch.hpp>

using namespace springlod;

TEST_CASE("The random generator reproduces the published numbers of SplitMix64") {
  // The first outputs of splitmix64.c from state 1234567.
  constexpr std::array<std::uint64_t, 3> published{6457827717110365317ULL, 3203168211198807973ULL,
                                                   9817491932198370423ULL};
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : published) {
    CHECK(split_mix(state) == expected);
    state += springlod::kSplitMixIncrement;
  }
}

TEST_CASE("A random stream repeats for one seed and differs between stream numbers") {
  RandomStream one(7, 3);
  RandomStream same(7, 3);
  RandomStream other(7, 4);
  int equal = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint64_t bits = one.bits();
    CHECK(bits == same.bits());
    equal += bits == other.bits() ? 1 : 0;
  }
  CHECK(equal == 0);
}

TEST_CASE("below() is uniform, and unit() lies between 0 and 1") {
  RandomStream random(1);
  constexpr int kDraws = 70000;
  std::array<int, 7> hits{};
  double sum = 0;
  for (int i = 0; i < kDraws; ++i) {
    ++hits.at(random.below(7));
    const double unit = random.unit();
    CHECK((unit >= 0 && unit < 1));
    sum += unit;
  }
  // Tolerances: five standard deviations of a count, and of a mean of uniform numbers.
  for (const int count : hits) CHECK(std::abs(count - 10000) < 5 * std::sqrt(10000.0 * 6 / 7));
  CHECK(std::abs(sum / kDraws - 0.5) < 5 / std::sqrt(12.0 * kDraws));
  CHECK(random.below(1) == 0);
}
