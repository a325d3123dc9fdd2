#include "voxelize/cells/slivers.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/grid.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using Catch::Matchers::Contains;

namespace {

VoxelizedMesh cells_of(const TriangleMesh& mesh, double cell = 1, Repair how = Repair::automatic) {
  VoxelizeOptions options;
  options.cell = cell;
  options.repair = how;
  return voxelize::voxelize(mesh, options);
}

std::vector<Sliver> slivers_of(const MaterialGrid& grid) {
  return find_slivers(grid.cells, std::vector<std::uint16_t>(grid.cells.size(), 0), *grid.distance,
                      grid.cell);
}

// A block with a plate of that thickness on it.
TriangleMesh block_with_plate(double thick) {
  TriangleMesh mesh;
  test::add_box(mesh, "block", {0, 0, 0}, {10, 10, 4});
  test::add_box(mesh, "plate", {4.5 - thick / 2, 0, 4}, {4.5 + thick / 2, 10, 10});
  return mesh;
}

}  // namespace

TEST_CASE("A plate one cell thick is a sliver, its thickness is measured") {
  const double thick = GENERATE(0.95, 1.05);
  CAPTURE(thick);
  const VoxelizedMesh result = cells_of(block_with_plate(thick));
  const std::vector<Sliver> slivers = slivers_of(result.grid);
  REQUIRE(slivers.size() == 1);
  CHECK(slivers[0].cells == 10 * 5);  // without the row on the block
  CHECK(slivers[0].thickness == Approx(thick).epsilon(0.02));
  REQUIRE(result.report.warnings.size() == 1);
  CHECK_THAT(result.report.warnings[0],
             Contains("\"plate\": 50 of its 60 cells") && Contains("use a cell of"));
  CHECK_THROWS_WITH(cells_of(block_with_plate(thick), 1, Repair::strict),
                    Contains("one cell thick"));
}

TEST_CASE("Two and more cells are no sliver, nor is the surface of a sphere") {
  CHECK(slivers_of(cells_of(block_with_plate(2)).grid).empty());
  TriangleMesh ball;
  test::add_sphere(ball, "ball", Vec3::Zero(), 1);
  for (const double cell : {0.05, 0.07, 0.1, 0.13})
    CHECK(slivers_of(cells_of(ball, cell).grid).empty());
}

TEST_CASE("The thickness of an oblique plate is measured across it") {
  TriangleMesh mesh;
  test::add_box(mesh, "plate", {-10, -10, -0.45}, {10, 10, 0.45});
  const double angle = GENERATE(0.2, 0.5, 0.785);
  CAPTURE(angle);
  for (Vec3& p : mesh.positions)
    p = Vec3(p.x() * std::cos(angle) - p.z() * std::sin(angle), p.y(),
             p.x() * std::sin(angle) + p.z() * std::cos(angle));
  const std::vector<Sliver> slivers = slivers_of(cells_of(mesh).grid);
  REQUIRE(slivers.size() == 1);
  CHECK(slivers[0].cells > 200);
  CHECK(slivers[0].thickness == Approx(0.9).epsilon(0.25));
}

TEST_CASE("The cell that is proposed resolves the sliver") {
  const TriangleMesh mesh = block_with_plate(1.05);
  const double thick = slivers_of(cells_of(mesh).grid).at(0).thickness;
  CHECK(slivers_of(cells_of(mesh, thick / 3).grid).empty());
}
