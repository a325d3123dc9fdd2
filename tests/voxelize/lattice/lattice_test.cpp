#include "voxelize/lattice/lattice.hpp"

#include <cmath>
#include <numeric>
#include <tuple>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/grids.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

LatticeModel build(const MaterialGrid& grid, LatticeStyle style,
                   HingePolicy hinges = HingePolicy::report) {
  return build_lattice(grid, {style, hinges});
}

// Stiffness and damping of the spring between the nodes at p and q; {0, 0} if there is none.
std::pair<double, double> spring_between(const MassSpringModel& m, const Vec3& p, const Vec3& q) {
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    if ((m.rest[m.a[s]].isApprox(p) && m.rest[m.b[s]].isApprox(q)) ||
        (m.rest[m.a[s]].isApprox(q) && m.rest[m.b[s]].isApprox(p)))
      return {m.stiffness[s], m.damping[s]};
  return {0, 0};
}

}  // namespace

TEST_CASE("A cube of 6^3 nodes has 2880 ends and 152 border nodes in both styles") {
  const auto corners = build(box_grid(5, 5, 5), LatticeStyle::corners).model;
  const auto centers = build(box_grid(6, 6, 6), LatticeStyle::centers).model;
  for (const MassSpringModel& model : {corners, centers}) {
    CHECK(model.node_count() == 216);
    CHECK(model.end_count() == 2880);
    CHECK(border_count(model) == 152);
  }
}

TEST_CASE("A cube of 5^3 nodes has 1560 ends and 98 border nodes in both styles") {
  const auto corners = build(box_grid(4, 4, 4), LatticeStyle::corners).model;
  const auto centers = build(box_grid(5, 5, 5), LatticeStyle::centers).model;
  for (const MassSpringModel& model : {corners, centers}) {
    CHECK(model.node_count() == 125);
    CHECK(model.end_count() == 1560);
    CHECK(border_count(model) == 98);
  }
}

TEST_CASE("A ball of the 281 lattice points nearest to its centre has 3856 ends") {
  const Vec3 center(0.04, 0.02, 0.01);
  std::vector<std::pair<double, CellIndex>> points;
  for (int z = -6; z <= 6; ++z)
    for (int y = -6; y <= 6; ++y)
      for (int x = -6; x <= 6; ++x)
        points.emplace_back((Vec3(x, y, z) - center).norm(), CellIndex{x, y, z});
  std::sort(points.begin(), points.end());
  std::vector<CellIndex> cells;
  for (std::size_t i = 0; i < 281; ++i) cells.push_back(points[i].second);
  const auto model = build(grid_of(cells, 0.1), LatticeStyle::centers).model;
  CHECK(model.node_count() == 281);
  CHECK(model.end_count() == 3856);
}

TEST_CASE("A rod of 4 x 4 x 23 nodes has 368 nodes and 4748 ends") {
  const auto lattice = build(box_grid(4, 4, 23, 0.1), LatticeStyle::centers);
  CHECK(lattice.model.node_count() == 368);
  CHECK(lattice.model.end_count() == 4748);
  CHECK(lattice.components == 1);
}

TEST_CASE("Mass and volume of the lattice are those of the cells") {
  MaterialGrid grid = box_grid(7, 5, 3, 0.013);
  for (std::size_t n = 0; n < grid.cells.size(); n += 3) grid.material[n] = 1;
  double mass = 0;
  for (const std::uint16_t m : grid.material)
    mass += grid.materials[m].density * std::pow(0.013, 3);
  const double volume = static_cast<double>(grid.cells.size()) * std::pow(0.013, 3);
  for (const LatticeStyle style : {LatticeStyle::corners, LatticeStyle::centers}) {
    const auto model = build(grid, style).model;
    CHECK(sum(model.mass) == Approx(mass).epsilon(1e-13));
    CHECK(sum(model.volume) == Approx(volume).epsilon(1e-13));
  }
}

TEST_CASE("The contact areas of a box add up to its surface") {
  // 3 x 4 x 5 cells of 0.5: 2 (12 + 15 + 20) faces of 0.25.
  for (const LatticeStyle style : {LatticeStyle::corners, LatticeStyle::centers}) {
    const auto model = build(box_grid(3, 4, 5, 0.5), style).model;
    CHECK(sum(model.contact_area) == Approx(94 * 0.25).epsilon(1e-14));
  }
}

TEST_CASE("A single corners cell has springs of k/4 at its edges and k/2 at its face diagonals") {
  const auto model = build(box_grid(1, 1, 1, 0.1), LatticeStyle::corners).model;
  const double k = 1e6 * 0.1 / 2.5;
  CHECK(model.node_count() == 8);
  CHECK(model.spring_count() == 24);
  const auto edge = spring_between(model, Vec3::Zero(), Vec3(0.1, 0, 0));
  const auto diagonal = spring_between(model, Vec3(0, 0.1, 0), Vec3(0.1, 0, 0));
  CHECK(edge.first == Approx(k / 4));
  CHECK(edge.second == Approx(0.002 * k / 4));
  CHECK(diagonal.first == Approx(k / 2));
  CHECK(diagonal.second == Approx(0.002 * k / 2));
  CHECK(model.mass[0] == Approx(1000 * 1e-3 / 8));
  CHECK(model.volume[0] == Approx(1e-3 / 8));
  CHECK(model.contact_area[0] == Approx(3 * 0.01 / 4));
}

TEST_CASE("All springs inside a lattice of one material have k = E a / 2.5") {
  const double k = 1e6 * 0.1 / 2.5;
  const auto centers = build(box_grid(3, 3, 3, 0.1), LatticeStyle::centers).model;
  for (std::uint32_t s = 0; s < centers.spring_count(); ++s) {
    REQUIRE(centers.stiffness[s] == k);
    REQUIRE(centers.damping[s] == 0.002 * k);
  }
  const auto corners = build(box_grid(4, 4, 4, 0.1), LatticeStyle::corners).model;
  for (std::uint32_t s = 0; s < corners.spring_count(); ++s)
    if (corners.border[corners.a[s]] == 0 || corners.border[corners.b[s]] == 0)
      REQUIRE(corners.stiffness[s] == Approx(k).epsilon(1e-14));
}

TEST_CASE("Eq. 2 gives Young's modulus of a corners lattice") {
  // Exact for uniform strain, including the surface.
  CHECK(estimated_young(build(box_grid(3, 4, 5, 0.01), LatticeStyle::corners).model) ==
        Approx(1e6).epsilon(1e-12));
}

TEST_CASE("A centers spring between two materials is two half springs in series") {
  MaterialGrid grid = box_grid(2, 1, 1, 0.1);
  grid.material[1] = 1;
  const auto model = build(grid, LatticeStyle::centers).model;
  const double k1 = 1e6 * 0.1 / 2.5;
  const double k2 = 4e6 * 0.1 / 2.5;
  REQUIRE(model.spring_count() == 1);
  CHECK(model.stiffness[0] == Approx(2 * k1 * k2 / (k1 + k2)));
  // The softer half has 4/5 of the elongation, so its damping time counts four times.
  CHECK(model.damping[0] == Approx(model.stiffness[0] * (0.8 * 0.002 + 0.2 * 0.0005)));
}

TEST_CASE("A corners spring between two materials has a contribution of each") {
  MaterialGrid grid = box_grid(2, 1, 1, 0.1);
  grid.material[1] = 1;
  const auto lattice = build(grid, LatticeStyle::corners);
  const double k1 = 1e6 * 0.1 / 2.5;
  const double k2 = 4e6 * 0.1 / 2.5;
  const auto shared = spring_between(lattice.model, Vec3(0.1, 0, 0), Vec3(0.1, 0.1, 0));
  CHECK(shared.first == Approx((k1 + k2) / 4));
  CHECK(shared.second == Approx((0.002 * k1 + 0.0005 * k2) / 4));
  // Equal volumes: the lower number.
  CHECK(lattice.model.material[1] == 0);
  CHECK(lattice.model.material[2] == 1);
}

TEST_CASE("Nodes are numbered by z, then y, then x, and have the positions of the grid") {
  MaterialGrid grid = box_grid(2, 3, 2, 0.5);
  grid.origin = Vec3(10, -4, 3);
  const auto corners = build(grid, LatticeStyle::corners).model;
  const auto centers = build(grid, LatticeStyle::centers).model;
  CHECK(corners.rest[0] == Vec3(10, -4, 3));
  CHECK(corners.rest[1] == Vec3(10.5, -4, 3));
  CHECK(corners.rest[3] == Vec3(10, -3.5, 3));
  CHECK(centers.rest[0] == Vec3(10.25, -3.75, 3.25));
  for (const MassSpringModel& m : {corners, centers})
    for (std::uint32_t i = 1; i < m.node_count(); ++i)
      REQUIRE(std::tuple(m.rest[i - 1].z(), m.rest[i - 1].y(), m.rest[i - 1].x()) <
              std::tuple(m.rest[i].z(), m.rest[i].y(), m.rest[i].x()));
}

TEST_CASE("Cells far apart make a lattice of several connected components") {
  const auto grid = grid_of({{0, 0, 0}, {900'000'000, -900'000'000, 7}});
  for (const LatticeStyle style : {LatticeStyle::corners, LatticeStyle::centers}) {
    const auto lattice = build(grid, style);
    CHECK(lattice.components == 2);
    CHECK(lattice.hinges.empty());
  }
}

TEST_CASE("An empty grid is rejected") {
  CHECK_THROWS_AS(build_lattice(grid_of({})), InputError);
}

TEST_CASE("A lattice of 100 thousand nodes has the counts of a cube") {
  const auto lattice = build(box_grid(46, 46, 46, 0.01), LatticeStyle::corners);
  const std::uint32_t n = 47;
  CHECK(lattice.model.node_count() == n * n * n);
  CHECK(lattice.model.spring_count() == 3 * (n - 1) * n * n + 6 * (n - 1) * (n - 1) * n);
  CHECK(lattice.components == 1);
}

}  // namespace springlod::voxelize
