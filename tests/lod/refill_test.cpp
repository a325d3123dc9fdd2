#include "lod/refill.hpp"

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "elastic/zero_modes.hpp"
#include "tests/voxelize/grids.hpp"
#include "voxelize/refill.hpp"

using namespace springlod;
using namespace springlod::elastic;
using namespace springlod::lod;
using namespace springlod::voxelize;
using test::box_grid;
using test::grid_of;

namespace {

MaterialGrid ball_grid(int radius) {
  std::vector<CellIndex> cells;
  for (int z = -radius; z <= radius; ++z)
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x)
        if (x * x + y * y + z * z <= radius * radius) cells.push_back({x, y, z});
  MaterialGrid grid = grid_of(cells, 0.01);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const CellIndex& c = grid.cells[n];
    grid.material[n] = c[0] * c[0] + c[1] * c[1] + c[2] * c[2] <= 9;
  }
  return grid;
}

void check_chain(const LodChain& chain) {
  const MassSpringModel& base = chain.levels[0].model;
  const MassProperties whole = mass_properties(base);
  for (const Level& level : chain.levels) {
    CHECK_NOTHROW(validate(level.model));
    CHECK_NOTHROW(validate(level.of_base));
    REQUIRE(level.of_base.of.size() == base.node_count());
    CHECK(level.of_base.count == level.model.node_count());
    const MassProperties p = mass_properties(level.model);
    CHECK(p.mass == Approx(whole.mass).epsilon(1e-12));
    CHECK(p.volume == Approx(whole.volume).epsilon(1e-12));
    for (const elastic::ComponentModes& part : elastic::zero_modes(level.model))
      CHECK(part.zero_modes == part.expected);
  }
}

TEST_CASE("The paper's figure 1: a cube refilled with lattices of 125, 64 and 27 nodes") {
  const auto style = GENERATE(LatticeStyle::corners, LatticeStyle::centers);
  const int n = style == LatticeStyle::corners ? 5 : 6;
  const MaterialGrid grid = box_grid(n, n, n, 0.6 / n);
  const MassSpringModel base = build_lattice(grid, {.style = style}).model;
  REQUIRE(base.node_count() == 216);
  const LodChain chain =
      refill(base, refill_levels(grid, {.nodes = {125, 64, 27}, .lattice = style}));
  REQUIRE(chain.levels.size() == 4);
  CHECK(chain.levels[1].model.node_count() == 125);
  CHECK(chain.levels[2].model.node_count() == 64);
  CHECK(chain.levels[3].model.node_count() == 27);
  check_chain(chain);
  for (const Level& level : chain.levels)
    CHECK(mass_properties(level.model).center.isApprox(mass_properties(base).center));
  if (style == LatticeStyle::corners)
    CHECK(elastic::stretch_test(chain.levels[2].model).young == Approx(1e6).epsilon(1e-6));
}

TEST_CASE("A refilled ball of two materials has about the requested number of nodes") {
  const MaterialGrid grid = ball_grid(6);
  const MassSpringModel base = build_lattice(grid).model;
  const LodChain lattices = refill(base, refill_levels(grid, {.nodes = {400, 160, 60}}));
  check_chain(lattices);
  for (std::size_t n = 1; n < lattices.levels.size(); ++n) {
    const double wanted = std::array{400, 160, 60}[n - 1];
    CHECK(lattices.levels[n].model.node_count() == Approx(wanted).epsilon(0.25));
  }
  const LodChain random = refill(
      base,
      refill_levels(grid, {.nodes = {400, 161, 57}, .style = RefillStyle::random, .seed = 2}));
  check_chain(random);
  CHECK(random.levels[1].model.node_count() == 400);
  CHECK(random.levels[2].model.node_count() == 161);
  CHECK(random.levels[3].model.node_count() == 57);
}

TEST_CASE("Base nodes are mapped to the nearest node of a refilled level") {
  const MaterialGrid grid = box_grid(8, 8, 8, 0.01);
  const MassSpringModel base = build_lattice(grid).model;
  const Level level =
      refill(base, refill_levels(grid, {.nodes = {100}, .style = RefillStyle::random})).levels[1];
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    const double own = (level.model.rest[level.of_base.of[i]] - base.rest[i]).norm();
    for (const Vec3& node : level.model.rest) REQUIRE(own <= (node - base.rest[i]).norm() + 1e-12);
  }
}

TEST_CASE("A refill that is not coarser than the level before is rejected") {
  const MaterialGrid grid = box_grid(4, 4, 4, 0.01);
  const MassSpringModel base = build_lattice(grid).model;
  CHECK_THROWS_AS(refill(base, refill_levels(grid, {})), InputError);
  CHECK_THROWS_WITH(refill(base, refill_levels(grid, {.nodes = {64, 64}})),
                    Catch::Contains("use fewer"));
  CHECK_THROWS_WITH(refill(base, refill_levels(grid, {.nodes = {300}})),
                    Catch::Contains("use fewer"));
}

}  // namespace
