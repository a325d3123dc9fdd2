// Lattices with corrected bending.
#include <cmath>
#include <numeric>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/moduli.hpp"
#include "elastic/zero_modes.hpp"
#include "tests/voxelize/grids.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

MassSpringModel lattice(const MaterialGrid& grid, Bending bending) {
  return build_lattice(grid, {.bending = bending}).model;
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::vector<std::uint32_t> nodes_at(const MassSpringModel& model, double x) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (std::abs(model.rest[i].x() - x) < 1e-9) nodes.push_back(i);
  return nodes;
}

}  // namespace

TEST_CASE("Corrected bending moves a twelfth of springs and mass from a free face inwards") {
  const MaterialGrid grid = box_grid(6, 5, 4);
  const MassSpringModel plain = lattice(grid, Bending::plain);
  const MassSpringModel corrected = lattice(grid, Bending::corrected);
  REQUIRE(plain.a == corrected.a);
  REQUIRE(plain.b == corrected.b);
  CHECK(sum(corrected.mass) == Approx(sum(plain.mass)).epsilon(1e-13));
  CHECK(sum(corrected.stiffness) == Approx(sum(plain.stiffness)).epsilon(1e-13));
  CHECK(corrected.contact_area == plain.contact_area);
  // Cells of a box: shares of its layers along an axis, over those of plain bending.
  const Box3 box = bounds(plain.rest);
  const double a = grid.cell;
  const auto share = [&](const Vec3& at, int axis) {
    const double depth = std::min(at[axis] - box.min()[axis], box.max()[axis] - at[axis]) / a;
    if (depth < 0.25) return 5. / 6;    // (1/2 - 1/12) / (1/2)
    if (depth < 1.25) return 13. / 12;  // 1 + 1/12
    return 1.;
  };
  for (std::uint32_t i = 0; i < plain.node_count(); ++i) {
    double wanted = plain.mass[i];
    for (int axis = 0; axis < 3; ++axis) wanted *= share(plain.rest[i], axis);
    CHECK(corrected.mass[i] == Approx(wanted).epsilon(1e-12));
    CHECK(corrected.volume[i] * grid.materials[0].density == Approx(wanted).epsilon(1e-12));
  }
  for (std::uint32_t s = 0; s < plain.spring_count(); ++s) {
    const Vec3& from = plain.rest[plain.a[s]];
    const Vec3 along = plain.rest[plain.b[s]] - from;
    double wanted = plain.stiffness[s];
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(along[axis]) < 1e-9) wanted *= share(from, axis);
    CHECK(corrected.stiffness[s] == Approx(wanted).epsilon(1e-12));
    CHECK(corrected.damping[s] * plain.stiffness[s] ==
          Approx(plain.damping[s] * wanted).margin(1e-15));
  }
}

TEST_CASE("A sheet of one layer of cells has the same springs with corrected bending across it") {
  const MaterialGrid grid = box_grid(1, 1, 1);
  const MassSpringModel plain = lattice(grid, Bending::plain);
  const MassSpringModel corrected = lattice(grid, Bending::corrected);
  CHECK(plain.stiffness == corrected.stiffness);
  CHECK(plain.mass == corrected.mass);
}

TEST_CASE("Corrected bending brings deflection, twist and inertia near theory with four cells") {
  constexpr int kCells = 4;
  constexpr int kAlong = 80;  // long: the clamp stiffens it by 1 % of kCells / kAlong
  const double young = 1e6;
  for (const double poisson : {0.25, 0.45}) {
    CAPTURE(poisson);
    MaterialGrid grid = box_grid(kAlong, kCells, kCells);
    grid.materials[0].young = young;
    grid.materials[0].poisson = poisson;
    const double h = kCells * grid.cell;
    const double length = kAlong * grid.cell;
    const double shear = young / (2 * (1 + poisson));
    const auto errors = [&](Bending bending) {
      const MassSpringModel bar = lattice(grid, bending);
      const Box3 box = bounds(bar.rest);
      const Vec3 center = box.center();
      const std::vector<std::uint32_t> end = nodes_at(bar, box.max().x());
      double area = 0;
      for (const std::uint32_t i : end) area += bar.volume[i];
      elastic::StaticLoad bend{"bend", std::vector<Vec3>(bar.node_count(), Vec3::Zero())};
      elastic::StaticLoad twist = bend;
      double torque = 0;
      for (const std::uint32_t i : end) {
        const Vec3 r = bar.rest[i] - center;
        const double part = bar.volume[i] / area;
        bend.force[i] = part * Vec3::UnitZ();
        twist.force[i] = part / h * Vec3(0, -r.z(), r.y());
        torque += part / h * (r.y() * r.y() + r.z() * r.z());
      }
      const auto solved = elastic::solve_static(
          elastic::elastic_body(bar, {.anchored = nodes_at(bar, box.min().x())}), {bend, twist});
      const double k = 10 * (1 + poisson) / (12 + 11 * poisson);  // Cowper 1966
      const double tip =
          std::pow(length, 3) / (3 * young * std::pow(h, 4) / 12) + length / (k * shear * h * h);
      constexpr double kSquare = 0.1406;  // of the torsion constant (Timoshenko & Goodier)
      const double turn = torque * torque * length / (kSquare * std::pow(h, 4) * shear);
      double inertia = 0;
      for (std::uint32_t i = 0; i < bar.node_count(); ++i) {
        const Vec3 r = bar.rest[i] - center;
        inertia += bar.mass[i] * (r.y() * r.y() + r.z() * r.z());
      }
      return std::array{solved[0].compliance / tip - 1, solved[1].compliance / turn - 1,
                        inertia / (sum(bar.mass) * h * h / 6) - 1};
    };
    const auto plain = errors(Bending::plain);
    const auto corrected = errors(Bending::corrected);
    CHECK(plain[0] < -0.04);
    CHECK(std::abs(corrected[0]) < 0.01);
    CHECK(std::abs(corrected[1]) < 0.6 * std::abs(plain[1]));
    CHECK(plain[2] == Approx(2. / (kCells * kCells)).epsilon(1e-9));
    CHECK(corrected[2] == Approx(2. / (kCells * kCells * kCells)).epsilon(1e-9));
  }
}

TEST_CASE("Corrected bending keeps E and nu, and makes no mechanism, on any shape") {
  const MaterialGrid grid = box_grid(12, 8, 8);
  const elastic::StretchResult found =
      elastic::stretch_test(lattice(grid, Bending::corrected), {.axis = 0, .cross_section = 64});
  CHECK(found.young == Approx(grid.materials[0].young).epsilon(1e-3));
  CHECK(found.poisson == Approx(0.25).margin(1e-3));
  std::vector<CellIndex> ball_cells;
  for (const CellIndex& cell : box_grid(9, 9, 9).cells)
    if (Vec3(cell[0] - 4, cell[1] - 4, cell[2] - 4).norm() < 4.2) ball_cells.push_back(cell);
  const MassSpringModel ball = lattice(grid_of(std::move(ball_cells)), Bending::corrected);
  for (const elastic::ComponentModes& part : elastic::zero_modes(ball))
    CHECK(part.zero_modes == part.expected);
}

TEST_CASE("Corrected bending of nodes at the centers of cells is refused") {
  CHECK_THROWS_AS(build_lattice(box_grid(2, 2, 2),
                                {.style = LatticeStyle::centers, .bending = Bending::corrected}),
                  InputError);
}

}  // namespace springlod::voxelize
