// Moduli of lattice bars in a stretch test, and their mechanisms (docs/method.md, eqs. 1, 4 and 5).

#include "elastic/moduli.hpp"

#include <cmath>
#include <vector>

#include <catch2/catch.hpp>

#include "elastic/elastic_body.hpp"
#include "elastic/modes.hpp"
#include "elastic/zero_modes.hpp"
#include "tests/voxelize/grids.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::voxelize {
namespace {

using test::box_grid;
using test::grid_of;

constexpr double kCell = 0.1;
constexpr double kYoung = 1e6;

/// Bar of nx x ny x nz cells, of material 0 of two.
MaterialGrid bar(int nx, int ny, int nz, double young = kYoung, double other = kYoung) {
  MaterialGrid grid = box_grid(nx, ny, nz, kCell);
  grid.materials[0].young = young;
  grid.materials[1].young = other;
  return grid;
}

MassSpringModel lattice(const MaterialGrid& grid, LatticeStyle style = LatticeStyle::corners) {
  return build_lattice(grid, {.style = style}).model;
}

TEST_CASE("A stretched corners bar of one material has its E and nu = 1/4") {
  const int axis = GENERATE(0, 1, 2);
  const elastic::StretchResult r = elastic::stretch_test(lattice(bar(3, 4, 6)), {.axis = axis});
  CHECK(r.young == Approx(kYoung).epsilon(1e-3));
  CHECK(r.poisson == Approx(0.25).margin(1e-3));
  // Exact (docs/method.md, eq. 4).
  CHECK(r.young == Approx(kYoung).epsilon(1e-7));
  CHECK(r.poisson == Approx(0.25).margin(1e-7));
}

TEST_CASE("A stretched corners bar has the E and nu that its material asks for") {
  const double nu = GENERATE(-0.2, -0.1, 0., 0.1, 0.3, 0.4, 0.45, 0.49, 0.495);
  const bool two = GENERATE(false, true);
  MaterialGrid grid = bar(4, 3, 8, 1e6, 3e6);
  for (Material& material : grid.materials) material.poisson = nu;
  if (two)
    for (std::size_t c = 0; c < grid.cells.size(); ++c) grid.material[c] = grid.cells[c][0] < 1;
  const MassSpringModel model = lattice(grid);
  const elastic::StretchResult r = elastic::stretch_test(model);
  const double young = two ? 0.75 * 1e6 + 0.25 * 3e6 : 1e6;
  CHECK(r.young == Approx(young).epsilon(1e-6));
  CHECK(r.poisson == Approx(nu).margin(1e-6));
  CHECK(model.dilatation.count() == grid.cells.size());
  // Terms add no mechanism, and negative ones make none.
  CHECK(elastic::elastic_body(model).zero_mode_count() == 6);
  CHECK(elastic::lowest_modes(model, {.count = 1}).modes.front().angular_frequency > 0);
}

TEST_CASE("A centers lattice has a term for each node, and nu inside") {
  MaterialGrid grid = bar(7, 7, 24);
  grid.materials[0].poisson = 0.45;
  const MassSpringModel model = lattice(grid, LatticeStyle::centers);
  CHECK(model.dilatation.count() == model.node_count());
  CHECK(elastic::stretch_test(model).poisson == Approx(0.45).margin(0.02));
}

TEST_CASE("Cells with and without terms stand side by side") {
  MaterialGrid grid = bar(4, 2, 2);
  grid.materials[1].poisson = 0.4;
  for (std::size_t c = 0; c < grid.cells.size(); ++c) grid.material[c] = grid.cells[c][0] < 1;
  const MassSpringModel model = lattice(grid);
  CHECK(model.dilatation.count() == 4);
  for (std::uint32_t t = 0; t < 4; ++t)
    CHECK(model.dilatation.modulus[t] ==
          Approx(dilatation_modulus(grid.materials[1]) * std::pow(kCell, 3)));
}

TEST_CASE("Separated hinges keep the terms of their cells") {
  MaterialGrid grid = grid_of({{0, 0, 0}, {1, 1, 0}}, kCell);
  grid.materials[0].poisson = 0.4;
  const MassSpringModel model = build_lattice(grid, {.hinges = HingePolicy::separate}).model;
  CHECK(connected_components(model).count == 2);
  CHECK(model.dilatation.count() == 2);
}

TEST_CASE("A stretched corners body of any cross-section has its E") {
  std::vector<CellIndex> cells;
  for (const CellIndex& at : bar(4, 4, 8).cells)
    if (at[0] < 2 || at[1] < 2) cells.push_back(at);
  MaterialGrid angle = grid_of(cells, kCell);
  const elastic::StretchResult r = elastic::stretch_test(lattice(angle));
  CHECK(r.young == Approx(kYoung).epsilon(1e-6));
  CHECK(r.poisson == Approx(0.25).margin(1e-6));
}

TEST_CASE("Two materials in parallel share the load by area") {
  MaterialGrid grid = bar(4, 4, 10, 1e6, 3e6);
  for (std::size_t c = 0; c < grid.cells.size(); ++c) grid.material[c] = grid.cells[c][0] < 1;
  const elastic::StretchResult r = elastic::stretch_test(lattice(grid));
  CHECK(r.young == Approx(0.75 * 1e6 + 0.25 * 3e6).epsilon(1e-3));
  CHECK(r.poisson == Approx(0.25).margin(1e-3));
}

TEST_CASE(
    "Two materials in series with a ratio of 10:1 agree with one-dimensional theory within 2 %") {
  MaterialGrid grid = bar(4, 4, 20, 1e6, 1e7);
  for (std::size_t c = 0; c < grid.cells.size(); ++c) grid.material[c] = grid.cells[c][2] >= 10;
  const double theory = 2 / (1 / 1e6 + 1 / 1e7);
  const double young = elastic::stretch_test(lattice(grid)).young;
  CHECK(young == Approx(theory).epsilon(0.02));
  // The interface restrains the contraction: 0.75 % above theory in an independent computation.
  CHECK(young / theory == Approx(1.0075).margin(5e-4));
}

TEST_CASE("A centers bar has the known border error") {
  const MassSpringModel m = lattice(bar(4, 4, 20), LatticeStyle::centers);
  const double whole = 4 * kCell;
  const double between = 3 * kCell;
  const double by_cells = elastic::stretch_test(m, {.cross_section = whole * whole}).young / kYoung;
  const double by_nodes =
      elastic::stretch_test(m, {.cross_section = between * between}).young / kYoung;
  CHECK(by_cells == Approx(0.83).margin(0.005));
  // 0.8297 x 16/9
  CHECK(by_nodes == Approx(1.475).margin(0.001));
}

TEST_CASE("Eq. 2 gives E of a corners lattice including its border") {
  const auto size = GENERATE(1, 3, 6);
  CHECK(estimated_young(lattice(bar(size, 2, 3))) == Approx(kYoung).epsilon(1e-12));
}

TEST_CASE("A solid lattice has six zero modes, its rigid motions") {
  const auto style = GENERATE(LatticeStyle::corners, LatticeStyle::centers);
  const auto parts = elastic::zero_modes(lattice(bar(3, 4, 5), style));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 6);
  CHECK(parts[0].expected == 6);
  CHECK(parts[0].mechanism_nodes.empty());
}

TEST_CASE("Two cells that share an edge have a hinge: seven zero modes") {
  const auto parts = elastic::zero_modes(lattice(grid_of({{0, 0, 0}, {1, 1, 0}})));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].node_count == 14);
  CHECK(parts[0].zero_modes == 7);
  CHECK(parts[0].mechanism_nodes.size() ==
        6);  // one cell rotates; the other one and the edge do not move
}

TEST_CASE("Two cells that share a corner have nine zero modes") {
  const auto parts = elastic::zero_modes(lattice(grid_of({{0, 0, 0}, {1, 1, 1}})));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 9);
  CHECK(parts[0].mechanism_nodes.size() == 7);
}

TEST_CASE("Two halves on a hinge: the mechanism nodes are those of the smaller half") {
  std::vector<CellIndex> cells = bar(4, 4, 4).cells;
  cells.push_back({4, 4, 3});
  cells.push_back({5, 4, 3});
  const auto parts = elastic::zero_modes(lattice(grid_of(cells)));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 7);
  CHECK(parts[0].mechanism_nodes.size() == 10);
}

}  // namespace
}  // namespace springlod::voxelize
