#include "voxelize/bodies.hpp"

#include <algorithm>
#include <cstdlib>
#include <random>

#include <catch2/catch.hpp>

namespace springlod::voxelize {
namespace {

// Each cell of a box with the given probability, in grid order.
std::vector<CellIndex> random_cells(std::mt19937_64& random, double probability) {
  std::bernoulli_distribution filled(probability);
  std::vector<CellIndex> cells;
  for (std::int32_t z = -2; z < 4; ++z)
    for (std::int32_t y = -3; y < 4; ++y)
      for (std::int32_t x = -4; x < 5; ++x)
        if (filled(random)) cells.push_back({x, y, z});
  return cells;
}

bool share_a_corner(const CellIndex& p, const CellIndex& q) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (std::abs(p[axis] - q[axis]) > 1) return false;
  return true;
}

}  // namespace

TEST_CASE("Bodies are the sets of cells that corners connect") {
  std::mt19937_64 random(GENERATE(range(1U, 20U)));
  const double probability = GENERATE(0.02, 0.08, 0.3, 0.9);
  const std::vector<CellIndex> cells = random_cells(random, probability);
  const auto count = static_cast<std::uint32_t>(cells.size());
  DisjointSets sets(count);
  for (std::uint32_t p = 0; p < count; ++p)
    for (std::uint32_t q = 0; q < p; ++q)
      if (share_a_corner(cells[p], cells[q])) sets.unite(p, q);
  const DisjointSets::Numbers expected = sets.numbers();
  const DisjointSets::Numbers found = bodies_of(cells);
  CHECK(found.count == expected.count);
  CHECK(found.of == expected.of);
}

TEST_CASE("No cells form no body") {
  CHECK(bodies_of({}).count == 0);
}

}  // namespace springlod::voxelize
