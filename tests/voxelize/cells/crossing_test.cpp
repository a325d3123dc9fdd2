// Surfaces that cross, lie in each other, or meet.

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/repair.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using Catch::Matchers::Contains;

namespace {

VoxelizedMesh cells_of(const TriangleMesh& mesh, Repair how = Repair::automatic) {
  VoxelizeOptions options;
  options.cell = 1;
  options.repair = how;
  return voxelize::voxelize(mesh, options);
}

}  // namespace

TEST_CASE("Of two boxes of one part that overlap, the common cells are filled and counted once") {
  TriangleMesh mesh;
  test::add_box(mesh, "cross", {0, 0, 0}, {8, 4, 4});
  test::add_box(mesh, "cross", {4, 0, 0}, {12, 4, 4});
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(result.grid.cells.size() == 12 * 4 * 4);
  CHECK(result.report.mesh_volume == Approx(12 * 4 * 4));
  CHECK(result.report.warnings.empty());
  REQUIRE(result.report.repairs.size() == 1);
  CHECK_THAT(result.report.repairs[0], Contains("\"cross\": 33 % of its volume"));
  CHECK_THROWS_WITH(cells_of(mesh, Repair::strict), Contains("more than once"));
}

TEST_CASE("The pocket between crossing surfaces stays empty") {
  // Two open crates, the upper one upside down; their walls cross.
  TriangleMesh mesh;
  const auto add_wall = [&](const Vec3& low, const Vec3& high) {
    test::add_box(mesh, "crates", low, high);
  };
  add_wall({0, 0, 0}, {10, 10, 2});
  add_wall({0, 0, 8}, {10, 10, 10});
  add_wall({0, 0, 0}, {2, 10, 10});
  add_wall({8, 0, 0}, {10, 10, 10});
  add_wall({0, 0, 0}, {10, 2, 10});
  add_wall({0, 8, 0}, {10, 10, 10});
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(result.grid.cells.size() == 1000 - 216);
  CHECK(result.report.mesh_volume == Approx(1000 - 216));
}

TEST_CASE("A body in a cavity stays") {
  TriangleMesh mesh;
  test::add_box(mesh, "rattle", {0, 0, 0}, {10, 10, 10});
  test::add_box(mesh, "rattle", {2, 2, 2}, {8, 8, 8});
  test::turn_inside_out(mesh, mesh.parts[1]);
  test::add_box(mesh, "rattle", {4, 4, 4}, {6, 6, 6});
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(result.grid.cells.size() == 1000 - 216 + 8);
  CHECK(result.report.mesh_volume == Approx(1000 - 216 + 8));
  CHECK(result.report.repairs.empty());
}

TEST_CASE(
    "A box that faces inwards beside the outer one is no cavity, though in its bounding box") {
  TriangleMesh mesh;  // an angle, and a box in its corner
  test::add_box(mesh, "angle", {0, 0, 0}, {10, 4, 2});
  test::add_box(mesh, "angle", {0, 0, 2}, {2, 4, 10});
  test::add_box(mesh, "angle", {5, 1, 5}, {7, 3, 7});
  test::turn_inside_out(mesh, mesh.parts[2]);
  CHECK(cells_of(mesh).grid.cells.size() == 80 + 64 + 8);
}

TEST_CASE("A surface that crosses itself is filled, inside out or not") {
  // A prism over a bow tie: two triangles of 43.2 and 19.2 m2, of which the second is reversed.
  TriangleMesh mesh;
  test::add_box(mesh, "bow", {-6, -6, 0}, {6, 6, 4});
  for (Vec3& p : mesh.positions)
    if (p.x() < 0) p.y() *= -2.0 / 3;
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(static_cast<double>(result.grid.cells.size()) == Approx((43.2 + 19.2) * 4).epsilon(0.1));
  REQUIRE(result.report.repairs.size() >= 1);
  CHECK_THAT(result.report.repairs[0], Contains("inside out"));
}

TEST_CASE("A part whose triangles have no area is reported, not dropped in silence") {
  TriangleMesh mesh;
  test::add_box(mesh, "box", {0, 0, 0}, {4, 4, 4});
  test::add_part(mesh, "dot", {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, {{0, 1, 2}});
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(result.grid.cells.size() == 64);
  REQUIRE(result.report.repairs.size() + result.report.warnings.size() == 1);
  const std::string line =
      result.report.repairs.empty() ? result.report.warnings[0] : result.report.repairs[0];
  CHECK_THAT(line, Contains("\"dot\""));
  CHECK_THROWS_AS(cells_of(mesh, Repair::strict), InputError);
}

TEST_CASE("Pieces of one surface with different materials form one solid, cracks and all") {
  TriangleMesh mesh;
  test::add_box(mesh, "box", {0, 0, 0}, {10, 10, 10}, "red");
  const std::vector<Triangle> all = mesh.triangles;
  mesh.parts = {{"box", "red", 0, 6}, {"box", "blue", 6, 6}};
  // The blue piece has vertices of its own, a hundredth of a cell away.
  for (std::size_t v = 0; v < 8; ++v)
    mesh.positions.push_back(mesh.positions[v] + Vec3(0.01, 0.01, 0.01));
  for (std::size_t t = 6; t < 12; ++t)
    for (std::uint32_t& v : mesh.triangles[t]) v += 8;
  const VoxelizedMesh result = cells_of(mesh);
  CHECK(static_cast<double>(result.grid.cells.size()) == Approx(1000).epsilon(0.02));
  REQUIRE(result.report.repairs.size() == 1);
  CHECK_THAT(result.report.repairs[0], Contains("\"box\"") && Contains("closed"));
}
