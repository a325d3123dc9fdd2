// Lattices of cut cells.
#include <cmath>
#include <numeric>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/modes.hpp"
#include "elastic/moduli.hpp"
#include "elastic/stable_step.hpp"
#include "elastic/zero_modes.hpp"
#include "model/components.hpp"
#include "tests/support/cut_ball.hpp"
#include "tests/voxelize/grids.hpp"
#include "voxelize/lattice/lattice.hpp"
#include "voxelize/random/random.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

}  // namespace

TEST_CASE("A lattice of cut cells has the mass of its fractions, and a moment near the ball's") {
  const MaterialGrid grid = cut_ball_grid(13.3);
  const MassSpringModel model = build_lattice(grid).model;
  CHECK(sum(model.mass) == Approx(1000 * volume(grid)).epsilon(1e-12));
  CHECK(sum(model.volume) == Approx(volume(grid)).epsilon(1e-12));
  const MassProperties whole = mass_properties(model);
  // Shared by halves, cells have moments that are too large: by the square of their size.
  const double excess = whole.inertia(0, 0) / (0.4 * whole.mass * 0.25) - 1;
  CHECK(excess > 0);
  CHECK(excess < 0.05);
}

TEST_CASE("One cut cell is the whole cell times its fraction") {
  MaterialGrid grid = grid_of({{0, 0, 0}});
  grid.materials[0].poisson = 0.4;
  const MassSpringModel whole = build_lattice(grid).model;
  grid.fraction = {0.25F};
  const MassSpringModel cut = build_lattice(grid).model;
  CHECK(cut.rest == whole.rest);
  for (std::uint32_t i = 0; i < whole.node_count(); ++i) {
    CHECK(cut.mass[i] == whole.mass[i] / 4);
    CHECK(cut.volume[i] == whole.volume[i] / 4);
    CHECK(cut.border[i] == 1);
  }
  for (std::uint32_t s = 0; s < whole.spring_count(); ++s) {
    CHECK(cut.stiffness[s] == whole.stiffness[s] / 4);
    CHECK(cut.damping[s] == whole.damping[s] / 4);
  }
  REQUIRE(cut.corner_count() == whole.corner_count());
  for (std::uint32_t c = 0; c < cut.corner_count(); ++c)
    CHECK(cut.corners[c].young == whole.corners[c].young / 4);
  CHECK(cut.dilatation.modulus[0] == whole.dilatation.modulus[0] / 4);
  CHECK(elastic::largest_frequency(cut) == Approx(elastic::largest_frequency(whole)));
}

TEST_CASE("No sliver of a cut cell vibrates faster than a whole cell, and no mechanism is added") {
  for (const double poisson : {0.25, 0.45})
    for (const double cells : {7.3, 8.0, 9.6}) {
      CAPTURE(poisson, cells);
      const MaterialGrid grid = cut_ball_grid(cells, poisson);
      const MassSpringModel model = build_lattice(grid).model;
      MaterialGrid one = grid_of({{0, 0, 0}}, grid.cell);
      one.materials = grid.materials;
      CHECK(elastic::largest_frequency(model) <=
            1.0001 * elastic::largest_frequency(build_lattice(one).model));
      const std::vector<elastic::ComponentModes> zero = elastic::zero_modes(model);
      REQUIRE(zero.size() == 1);
      CHECK(zero[0].zero_modes == 6);
    }
}

TEST_CASE("The frequencies of a ball of cut cells hardly depend on where the grid lies") {
  // The lowest torsional and ellipsoidal modes, five of each (Lamb 1882).
  const double shear_speed = std::sqrt(1e6 / 2.5 / 1000);
  for (const double cells : {8.0, 8.4, 8.8}) {
    CAPTURE(cells);
    const elastic::Modes found = elastic::lowest_modes(cut_ball(cells), {.count = 10});
    double mean = 0;
    for (const elastic::Mode& mode : found.modes) mean += mode.angular_frequency / 10;
    CHECK(mean == Approx((2.50113 + 2.63987) / 2 * shear_speed / 0.5).epsilon(0.05));
  }
}

TEST_CASE("Points of the surface of a lattice lie where the grid has them, and share their area") {
  const MaterialGrid grid = cut_ball_grid(9.4);
  const MassSpringModel model = build_lattice(grid).model;
  validate(model);
  REQUIRE(model.surface.count() == grid.surface.size());
  const std::vector<Vec3> at = interpolate(model.surface.of_nodes, model.rest);
  for (std::uint32_t p = 0; p < model.surface.count(); ++p) {
    const SurfacePoint& point = grid.surface[p];
    const Vec3 place =
        grid.center(point.cell) + grid.cell * Vec3(point.place[0], point.place[1], point.place[2]);
    CHECK((at[p] - place).norm() < 1e-12);
    CHECK(at[p].norm() == Approx(0.5).epsilon(5e-3));
    // Three springs' worth for each face of a cell: a layer that cannot spread.
    const double spring = 1e6 * grid.cell / 2.5;
    CHECK(model.surface.stiffness[p] == Approx(3 * spring * point.area / (grid.cell * grid.cell)));
  }
  CHECK(sum(model.contact_area) == Approx(sum(model.surface.area)).epsilon(1e-3));
}

TEST_CASE("A lattice of whole cells on the grid is the same with cut cells, but for its surface") {
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {5, 4, 3});
  VoxelizeOptions options;
  options.cell = 1;
  const auto model_of = [&] {
    return build_lattice(voxelize::voxelize(mesh, options).grid, {.bending = Bending::corrected})
        .model;
  };
  const MassSpringModel whole = model_of();
  options.cut_cells = true;
  const MassSpringModel cut = model_of();
  CHECK(cut.mass == whole.mass);
  CHECK(cut.stiffness == whole.stiffness);
  CHECK(cut.border == whole.border);
  CHECK(whole.surface.empty());
  CHECK(sum(cut.contact_area) == Approx(sum(whole.contact_area)).epsilon(1e-6));
}

TEST_CASE("The parts of a body keep their points of the surface") {
  TriangleMesh mesh;
  add_sphere(mesh, "a", {0, 0, 0}, 1);
  add_sphere(mesh, "b", {4, 0, 0}, 1);
  VoxelizeOptions options;
  options.cell = 0.3;
  options.cut_cells = true;
  const MassSpringModel both = build_lattice(voxelize::voxelize(mesh, options).grid).model;
  const std::vector<ModelComponent> parts = split_components(both, connected_components(both));
  REQUIRE(parts.size() == 2);
  std::uint32_t points = 0;
  for (const ModelComponent& part : parts) {
    validate(part.model);
    points += part.model.surface.count();
    const double middle = part.model.rest[0].x() < 2 ? 0 : 4;
    for (const Vec3& at : interpolate(part.model.surface.of_nodes, part.model.rest))
      CHECK((at - Vec3(middle, 0, 0)).norm() == Approx(1).epsilon(0.02));
  }
  CHECK(points == both.surface.count());
}

TEST_CASE("Cut cells are refused for nodes at centres, and whole in random models") {
  const MaterialGrid grid = cut_ball_grid(8);
  CHECK_THROWS_AS(build_lattice(grid, {.style = LatticeStyle::centers}), InputError);
  const MassSpringModel random = build_random(grid, {.nodes = 200}).model;
  CHECK(random.surface.empty());
  CHECK(sum(random.volume) == Approx(volume(whole_cells(grid))).epsilon(1e-9));
}

TEST_CASE("Cells that mend hinges of cut cells are whole, and cells keep their fractions") {
  MaterialGrid grid = grid_of({{0, 0, 0}, {1, 1, 0}});
  grid.fraction = {0.5F, 0.75F};
  const LatticeModel mended = build_lattice(grid, {.hinges = HingePolicy::fill});
  CHECK(mended.filled_cells == 1);
  CHECK(sum(mended.model.volume) == Approx(0.5 + 0.75 + 1));
}

}  // namespace springlod::voxelize
