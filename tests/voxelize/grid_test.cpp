#include "voxelize/grid.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/grids.hpp"

namespace springlod::voxelize {

using namespace springlod::test;
using Catch::Matchers::Contains;

TEST_CASE("A consistent grid is valid, with or without depths") {
  MaterialGrid grid = box_grid(3, 2, 2);
  CHECK_NOTHROW(validate(grid));
  grid.depth.clear();
  CHECK_NOTHROW(validate(grid));
}

TEST_CASE("Unsorted and repeated cells are rejected with their index") {
  MaterialGrid grid = box_grid(2, 2, 1);
  std::swap(grid.cells[1], grid.cells[2]);
  CHECK_THROWS_WITH(validate(grid), Contains("(1, 0, 0) comes after (0, 1, 0)"));
  grid.cells[2] = grid.cells[1];
  CHECK_THROWS_WITH(validate(grid), Contains("(0, 1, 0) occurs twice"));
}

TEST_CASE("A grid with inconsistent sizes, numbers or cell edges is rejected") {
  const MaterialGrid good = box_grid(2, 2, 1);
  const auto refused = [&](auto&& spoil) {
    MaterialGrid grid = good;
    spoil(grid);
    CHECK_THROWS_AS(validate(grid), InputError);
  };
  refused([](MaterialGrid& g) { g.material[3] = 2; });
  refused([](MaterialGrid& g) { g.material.pop_back(); });
  refused([](MaterialGrid& g) { g.depth.pop_back(); });
  refused([](MaterialGrid& g) { g.cell = 0; });
  refused([](MaterialGrid& g) { g.cell = std::numeric_limits<double>::quiet_NaN(); });
  refused([](MaterialGrid& g) { g.origin.x() = std::numeric_limits<double>::infinity(); });
  refused([](MaterialGrid& g) { g.materials[0].young = -1; });
  refused([](MaterialGrid& g) { g.cells[3] = {0, 0, std::numeric_limits<std::int32_t>::max()}; });
}

}  // namespace springlod::voxelize
