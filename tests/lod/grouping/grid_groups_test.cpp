#include "lod/grouping/grid_groups.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "lod/build.hpp"
#include "tests/lod/bodies.hpp"

using namespace springlod;
using namespace springlod::lod;

TEST_CASE("A grid makes as many groups as wanted, each held together by springs") {
  const MassSpringModel base = test::ball();
  for (const std::uint32_t count : {20U, 60U, 140U}) {
    const Groups groups = grid_groups({base, SpringRows(base), count, {}});
    validate(groups);
    CHECK(groups.count == count);
    std::vector<std::vector<std::uint32_t>> members(groups.count);
    for (std::uint32_t i = 0; i < base.node_count(); ++i) members[groups.of[i]].push_back(i);
    CHECK_NOTHROW(groups_from_sets(base, members));
  }
  CHECK_THROWS_AS(grid_groups({base, SpringRows(base), 0, {}}), InputError);
}

TEST_CASE("Levels can be made by a grid") {
  const LodChain chain =
      simplify(test::ball(), {.keep = {0.4, 0.2}, .grouping = {.grouping = Grouping::grid}});
  CHECK(chain.levels[2].made_by == "grid, border none, seed 1");
}
