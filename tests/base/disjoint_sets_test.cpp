#include "base/disjoint_sets.hpp"

#include <catch2/catch.hpp>

using namespace springlod;

TEST_CASE("A set is represented and numbered by its lowest element") {
  DisjointSets sets(7);
  CHECK(sets.unite(5, 2));
  CHECK(sets.unite(6, 5));
  CHECK(sets.unite(4, 1));
  CHECK_FALSE(sets.unite(2, 6));
  CHECK(sets.lowest(6) == 2);
  CHECK(sets.lowest(4) == 1);
  CHECK(sets.lowest(3) == 3);
  const DisjointSets::Numbers numbers = sets.numbers();
  CHECK(numbers.count == 4);
  CHECK(numbers.of == std::vector<std::uint32_t>{0, 1, 2, 3, 1, 2, 2});
}

TEST_CASE("The order of unions does not matter") {
  constexpr std::uint32_t kCount = 1000;
  DisjointSets rising(kCount);
  DisjointSets falling(kCount);
  for (std::uint32_t i = 0; i + 3 < kCount; ++i) rising.unite(i, i + 3);
  for (std::uint32_t i = kCount - 3; i-- > 0;) falling.unite(i + 3, i);
  CHECK(rising.numbers().count == 3);
  CHECK(rising.numbers().of == falling.numbers().of);
  CHECK(rising.numbers().of[kCount - 1] == (kCount - 1) % 3);
}
