// What bars of the lattices show in a solved stretch test (spec 2.4), and their mechanisms.

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include <catch2/catch.hpp>

#include "model/stiffness.hpp"
#include "model/zero_modes.hpp"
#include "voxelize/lattice.hpp"

namespace springlod {
namespace {

constexpr double kCell = 0.1;
constexpr double kYoung = 1e6;

/// Bar of nx x ny x nz cells; `number` tells each cell's material from its place.
template <class Number>
MaterialGrid bar(int nx, int ny, int nz, std::vector<double> youngs, const Number& number) {
  MaterialGrid grid;
  grid.cell = kCell;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        grid.cells.push_back({x, y, z});
        grid.material.push_back(static_cast<std::uint16_t>(number(x, y, z)));
        grid.depth.push_back(0);
      }
  for (std::size_t i = 0; i < youngs.size(); ++i)
    grid.materials.push_back({"material " + std::to_string(i), youngs[i], 1000, 0.002, {}});
  return grid;
}

MaterialGrid plain_bar(int nx, int ny, int nz) {
  return bar(nx, ny, nz, {kYoung}, [](int, int, int) { return 0; });
}

MassSpringModel lattice(const MaterialGrid& grid, LatticeStyle style = LatticeStyle::corners) {
  return build_lattice(grid, {.style = style}).model;
}

MaterialGrid cells(const std::vector<CellIndex>& at) {
  MaterialGrid grid = plain_bar(1, 1, 1);
  grid.cells = at;
  grid.material.assign(at.size(), 0);
  grid.depth.assign(at.size(), 0);
  return grid;
}

TEST_CASE("A stretched corners bar of one material shows its E and nu = 1/4") {
  const int axis = GENERATE(0, 1, 2);
  const StretchResult r = stretch_test(lattice(plain_bar(3, 4, 6)), {.axis = axis});
  CHECK(r.young == Approx(kYoung).epsilon(1e-3));
  CHECK(r.poisson == Approx(0.25).margin(1e-3));
  // Exact, says the spec: better than asked for.
  CHECK(r.young == Approx(kYoung).epsilon(1e-7));
  CHECK(r.poisson == Approx(0.25).margin(1e-7));
}

TEST_CASE("A stretched corners body of any cross-section shows its E") {
  MaterialGrid grid = plain_bar(4, 4, 8);
  MaterialGrid angle = grid;
  angle.cells.clear();
  for (const CellIndex& at : grid.cells)
    if (at[0] < 2 || at[1] < 2) angle.cells.push_back(at);
  angle.material.resize(angle.cells.size());
  angle.depth.resize(angle.cells.size());
  const StretchResult r = stretch_test(lattice(angle));
  CHECK(r.young == Approx(kYoung).epsilon(1e-6));
  CHECK(r.poisson == Approx(0.25).margin(1e-6));
}

TEST_CASE("Two materials side by side along the load share it by area") {
  const auto grid = bar(4, 4, 10, {1e6, 3e6}, [](int x, int, int) { return x < 1 ? 1 : 0; });
  const StretchResult r = stretch_test(lattice(grid));
  CHECK(r.young == Approx(0.75 * 1e6 + 0.25 * 3e6).epsilon(1e-3));
  CHECK(r.poisson == Approx(0.25).margin(1e-3));
}

TEST_CASE("Two materials in series at 10:1 lie within 2 % of one-dimensional theory") {
  const auto grid = bar(4, 4, 20, {1e6, 1e7}, [](int, int, int z) { return z < 10 ? 0 : 1; });
  const double theory = 2 / (1 / 1e6 + 1 / 1e7);
  const double young = stretch_test(lattice(grid)).young;
  CHECK(young == Approx(theory).epsilon(0.02));
  // The joint hinders the contraction: 0.75 % above theory in an independent computation.
  CHECK(young / theory == Approx(1.0075).margin(5e-4));
}

TEST_CASE("A centers bar has the known border error") {
  const MassSpringModel m = lattice(plain_bar(4, 4, 20), LatticeStyle::centers);
  const double whole = 4 * kCell;
  const double between = 3 * kCell;
  CHECK(stretch_test(m, {.cross_section = whole * whole}).young / kYoung ==
        Approx(0.83).margin(0.005));
  CHECK(stretch_test(m, {.cross_section = between * between}).young / kYoung ==
        Approx(1.47).margin(0.005));
}

TEST_CASE("A sound lattice has its six rigid motions and no more") {
  const auto style = GENERATE(LatticeStyle::corners, LatticeStyle::centers);
  const auto parts = zero_modes(lattice(plain_bar(3, 4, 5), style));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 6);
  CHECK(parts[0].expected == 6);
  CHECK(parts[0].mechanism_nodes.empty());
}

TEST_CASE("Two cells that share an edge have a hinge: seven zero modes") {
  const auto parts = zero_modes(lattice(cells({{0, 0, 0}, {1, 1, 0}})));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].node_count == 14);
  CHECK(parts[0].zero_modes == 7);
  CHECK(parts[0].mechanism_nodes.size() == 6);  // one cell turns, the other and the edge stay
}

TEST_CASE("Two cells that share a corner have nine zero modes") {
  const auto parts = zero_modes(lattice(cells({{0, 0, 0}, {1, 1, 1}})));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 9);
  CHECK(parts[0].mechanism_nodes.size() == 7);
}

TEST_CASE("A body of two halves on a hinge names the smaller half") {
  MaterialGrid grid = plain_bar(4, 4, 4);
  grid.cells.push_back({4, 4, 3});
  grid.cells.push_back({5, 4, 3});
  std::sort(grid.cells.begin(), grid.cells.end(), [](const CellIndex& p, const CellIndex& q) {
    return std::tie(p[2], p[1], p[0]) < std::tie(q[2], q[1], q[0]);
  });
  grid.material.assign(grid.cells.size(), 0);
  grid.depth.assign(grid.cells.size(), 0);
  const auto parts = zero_modes(lattice(grid));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 7);
  CHECK(parts[0].mechanism_nodes.size() == 10);
}

}  // namespace
}  // namespace springlod
