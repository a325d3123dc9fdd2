// The estimate of a body's lowest frequency, and the damping times that follow from it.

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/modes.hpp"
#include "elastic/stable_step.hpp"
#include "tests/voxelize/grids.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/lattice/lattice.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using springlod::test::box_grid;
using springlod::test::grid_of;

namespace {

constexpr double kPi = std::numbers::pi;

}  // namespace

TEST_CASE("The estimate is pi c over the longest side of the box of cells") {
  const double wave_speed = std::sqrt(1e6 / 1000);
  CHECK(lowest_frequency(box_grid(2, 3, 8, 0.1)) == Approx(kPi * wave_speed / 0.8));
  CHECK(lowest_frequency(box_grid(8, 2, 3, 0.1)) == Approx(kPi * wave_speed / 0.8));
  CHECK(lowest_frequency(grid_of({})) == 0);
}

TEST_CASE("The estimate is inversely proportional to the size of the body") {
  const double metres = lowest_frequency(box_grid(3, 2, 2, 0.1));
  CHECK(lowest_frequency(box_grid(3, 2, 2, 0.1e-3)) == Approx(1000 * metres));
}

TEST_CASE("Materials count as layers in series") {
  MaterialGrid grid = box_grid(1, 1, 4, 0.1);
  grid.material = {0, 1, 1, 1};  // 1 MPa and 1000 kg/m3; 4 MPa and 2500 kg/m3
  const double young = 4 / (1 / 1e6 + 3 / 4e6);
  const double density = (1000 + 3 * 2500) / 4.0;
  CHECK(lowest_frequency(grid) == Approx(kPi * std::sqrt(young / density) / 0.4));
}

TEST_CASE("The slowest connected component counts, not the distance between components") {
  const double alone = lowest_frequency(box_grid(1, 1, 3));
  CHECK(lowest_frequency(grid_of({{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {50, 0, 0}})) == alone);
  // Cells that share only a corner are one component.
  CHECK(lowest_frequency(grid_of({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}})) == Approx(alone));
  // A soft component that is smaller may be the slowest one.
  MaterialGrid grid = grid_of({{0, 0, 0}, {0, 0, 1}, {50, 0, 0}});
  grid.materials[0].young = 100;
  grid.material = {1, 0, 1};  // in grid order the far cell is the second
  CHECK(lowest_frequency(grid) == Approx(kPi * std::sqrt(0.1)));
}

TEST_CASE("Damping ratios of a grid become times, given times stay") {
  MaterialGrid grid = box_grid(2, 2, 4, 0.1);
  const MaterialInput by_ratio{.material = {.name = "ratio", .young = 1e6, .density = 1000},
                               .damping_ratio = 0.03};
  const MaterialInput by_time{.material = {.name = "time", .damping = 0.004},
                              .damping_ratio = std::nullopt};
  set_materials(grid, {by_ratio, by_time});
  REQUIRE(grid.materials.size() == 2);
  CHECK(grid.materials[0].damping == Approx(2 * 0.03 / lowest_frequency(grid)));
  CHECK(grid.materials[1] == by_time.material);
  CHECK_THROWS_AS(set_materials(grid, {{{.name = "m"}, 1.5}}), InputError);
  CHECK_THROWS_AS(set_materials(grid, {}), InputError);
}

TEST_CASE("In a ball, the slowest vibration is damped by the ratio within 10 %") {
  std::vector<CellIndex> cells;
  for (const CellIndex& cell : box_grid(12, 12, 12).cells)
    if ((Vec3(cell[0], cell[1], cell[2]) - Vec3::Constant(5.5)).norm() < 6) cells.push_back(cell);
  MaterialGrid grid = grid_of(cells, 0.1);
  set_materials(grid, {{{.name = "m"}}});
  const elastic::Modes modes = elastic::lowest_modes(build_lattice(grid).model, {.count = 1});
  const double omega = modes.modes.at(0).angular_frequency;
  CHECK(grid.materials[0].damping * omega / 2 == Approx(kUsualDampingRatio).epsilon(0.1));
}

TEST_CASE("The same mesh in millimetres and metres has the same step in its own periods") {
  const auto steps_per_period = [](double scale) {
    TriangleMesh mesh;
    test::add_box(mesh, "box", {0, 0, 0}, scale * Vec3(3, 2, 6));
    VoxelizeOptions options;
    options.cell = 0.5 * scale;
    const MaterialGrid grid = voxelize::voxelize(mesh, options).grid;
    const MassSpringModel model = build_lattice(grid).model;
    return std::pair(lowest_frequency(grid) * elastic::stable_step(model),
                     model.materials[0].damping * lowest_frequency(grid));
  };
  const auto [metres, ratio_in_metres] = steps_per_period(1);
  const auto [millimetres, ratio_in_millimetres] = steps_per_period(1e-3);
  CHECK(millimetres == Approx(metres).epsilon(1e-9));
  CHECK(ratio_in_metres == Approx(2 * kUsualDampingRatio));
  CHECK(ratio_in_millimetres == Approx(2 * kUsualDampingRatio));
}
