#include "lod/grouping/radix_sort.hpp"

#include <algorithm>
#include <limits>

#include <catch2/catch.hpp>

#include "base/random.hpp"

using namespace springlod;
using namespace springlod::lod;

TEST_CASE("The radix sort agrees with a stable sort") {
  for (const unsigned bits : {1U, 7U, 12U, 33U, 64U}) {
    std::vector<KeyedNode> nodes;
    for (std::uint32_t i = 0; i < 5000; ++i) nodes.push_back({split_mix(i) >> (64U - bits), i});
    std::vector<KeyedNode> expected = nodes;
    std::stable_sort(expected.begin(), expected.end(),
                     [](const KeyedNode& x, const KeyedNode& y) { return x.key < y.key; });
    radix_sort(nodes);
    REQUIRE(std::equal(
        nodes.begin(), nodes.end(), expected.begin(),
        [](const KeyedNode& x, const KeyedNode& y) { return x.key == y.key && x.node == y.node; }));
  }
  std::vector<KeyedNode> none;
  radix_sort(none);
  CHECK(none.empty());
}

TEST_CASE("Radix keys have the order of their numbers") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::vector<double> rising{-kInfinity, -1e300, -2,   -1,    -1e-310,  0,
                                   1e-310,     1,      1.25, 1e300, kInfinity};
  for (std::size_t i = 1; i < rising.size(); ++i)
    CHECK(radix_key(rising[i - 1]) < radix_key(rising[i]));
  CHECK(radix_key(-0.0) == radix_key(0.0));
}
