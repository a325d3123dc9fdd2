#include "voxelize/cells/separate.hpp"

#include <catch2/catch.hpp>

#include "tests/voxelize/grids.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/grid.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using Catch::Matchers::EndsWith;

namespace {

// A crumb of one cell, a ball, and a block of another material, each its own mesh part.
TriangleMesh three_bodies() {
  TriangleMesh mesh;
  test::add_box(mesh, "crumb", {0, 0, 5}, {1, 1, 6}, "rock");
  test::add_sphere(mesh, "ball", {10.5, 2.5, 2.5}, 2.5);
  test::add_box(mesh, "block", {0, 0, 0}, {6, 6, 3});
  return mesh;
}

VoxelizedMesh cells_of(const TriangleMesh& mesh) {
  VoxelizeOptions options;
  options.cell = 1;
  options.materials["block"] = {.material = {.name = "steel", .young = 4e6}};
  return voxelize::voxelize(mesh, options);
}

std::vector<std::string> names_of(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  for (const MeshPart& part : mesh.parts) names.push_back(part.name);
  return names;
}

}  // namespace

TEST_CASE("Each body has its cells, materials and triangles, the largest first") {
  const TriangleMesh mesh = three_bodies();
  const MaterialGrid grid = cells_of(mesh).grid;
  CHECK(count_bodies(grid) == 3);
  const SeparateBodies found = separate_bodies(grid, mesh);
  REQUIRE(found.bodies.size() == 3);
  CHECK(found.stray_triangles == 0);
  const auto& [block, ball, crumb] = std::tie(found.bodies[0], found.bodies[1], found.bodies[2]);
  CHECK(block.grid.cells.size() == 108);
  CHECK(crumb.grid.cells.size() == 1);
  CHECK(block.grid.cells.size() + ball.grid.cells.size() + 1 == grid.cells.size());
  CHECK(block.grid.materials.at(0).name == "steel");
  CHECK(ball.grid.materials.at(0).name == "default");
  std::size_t triangles = 0;
  for (const GridBody& body : found.bodies) {
    CHECK_NOTHROW(validate(body.grid));
    CHECK_NOTHROW(validate(body.mesh));
    CHECK(body.grid.materials.size() == 1);
    triangles += body.mesh.triangles.size();
  }
  CHECK(triangles == mesh.triangles.size());
  CHECK(names_of(block.mesh) == std::vector<std::string>{"block"});
  CHECK(names_of(ball.mesh) == std::vector<std::string>{"ball"});
  CHECK(names_of(crumb.mesh) == std::vector<std::string>{"crumb"});
  CHECK(crumb.mesh.parts[0].material == "rock");
  CHECK(ball.mesh.positions.size() == 2 + 47 * 96);
  CHECK(signed_volume(ball.mesh, ball.mesh.parts[0]) == signed_volume(mesh, mesh.parts[1]));
}

TEST_CASE("The warning of several bodies has their range of sizes, or the one size of all") {
  TriangleMesh mesh;
  test::add_box(mesh, "left", {0, 0, 0}, {2, 2, 2});
  test::add_box(mesh, "right", {5, 0, 0}, {7, 2, 2});
  const auto warning = [&] {
    for (const std::string& text : cells_of(mesh).report.warnings)
      if (text.find("bodies") != std::string::npos) return text;
    return std::string();
  };
  CHECK_THAT(warning(), EndsWith("2 bodies that do not touch, of 8 cells each"));
  test::add_box(mesh, "crumb", {9, 0, 0}, {10, 1, 1});
  CHECK_THAT(warning(), EndsWith("3 bodies that do not touch, of 1 to 8 cells"));
}

TEST_CASE("A damping ratio is that of the body, a damping time stays") {
  const TriangleMesh mesh = three_bodies();
  MaterialGrid grid = cells_of(mesh).grid;
  TriangleMesh ball;
  test::add_sphere(ball, "ball", {10.5, 2.5, 2.5}, 2.5);
  CHECK(separate_bodies(grid, mesh).bodies[1].grid.materials[0].damping ==
        Approx(cells_of(ball).grid.materials[0].damping));
  grid.inputs.clear();  // as for a grid from a file, whose ratios are not known
  CHECK(separate_bodies(grid, mesh).bodies[1].grid.materials[0].damping ==
        grid.materials[grid.material.back()].damping);
}

TEST_CASE("Debris too small for a cell belongs to no body, a flag at a body to that body") {
  TriangleMesh mesh;
  test::add_box(mesh, "block", {0, 0, 0}, {6, 6, 3});
  test::add_sphere(mesh, "dust", {3, 3, 8}, 0.3, 4);
  test::add_part(mesh, "flag", {{3, 3, 3}, {3, 3, 9}, {6, 3, 9}}, {{0, 1, 2}, {0, 2, 1}});
  test::add_box(mesh, "other", {10, 0, 0}, {12, 2, 2});
  const SeparateBodies found = separate_bodies(cells_of(mesh).grid, mesh);
  REQUIRE(found.bodies.size() == 2);
  CHECK(found.stray_triangles == mesh.parts[1].triangle_count + 2);
  CHECK(names_of(found.bodies[0].mesh) == std::vector<std::string>{"block"});
}

TEST_CASE("A neck that the cells do not resolve is divided between both bodies") {
  TriangleMesh mesh;
  // A bar of 2 x 2 x 12 that is 0.2 wide in the middle,.
  const std::vector<Vec3> outline{{0, 0, 0},   {5, 0, 0},   {5, 0.9, 0}, {7, 0.9, 0},
                                  {7, 0, 0},   {12, 0, 0},  {12, 2, 0},  {7, 2, 0},
                                  {7, 1.1, 0}, {5, 1.1, 0}, {5, 2, 0},   {0, 2, 0}};
  std::vector<Vec3> positions = outline;
  for (const Vec3& p : outline) positions.emplace_back(p.x(), p.y(), 2);
  std::vector<Triangle> triangles;
  for (std::uint32_t n = 0; n < 12; ++n) {
    const std::uint32_t next = (n + 1) % 12;
    triangles.push_back({n, next, next + 12});
    triangles.push_back({n, next + 12, n + 12});
  }
  for (const Triangle& t : {Triangle{0, 1, 2},
                            {0, 2, 9},
                            {0, 9, 10},
                            {0, 10, 11},
                            {2, 3, 8},
                            {2, 8, 9},
                            {3, 4, 5},
                            {3, 5, 6},
                            {3, 6, 8},
                            {6, 7, 8}}) {
    triangles.push_back({t[0], t[2], t[1]});
    triangles.push_back({t[0] + 12, t[1] + 12, t[2] + 12});
  }
  test::add_part(mesh, "bar", positions, triangles);
  REQUIRE(signed_volume(mesh, mesh.parts[0]) == Approx(2 * 2 * 10 + 0.2 * 2 * 2));
  const MaterialGrid grid = cells_of(mesh).grid;
  const SeparateBodies found = separate_bodies(grid, mesh);
  REQUIRE(found.bodies.size() == 2);
  CHECK(found.bodies[0].grid.cells.size() == 20);
  CHECK(found.bodies[1].grid.cells.size() == 20);
  CHECK(found.bodies[0].mesh.triangles.size() + found.bodies[1].mesh.triangles.size() ==
        mesh.triangles.size());
  for (const GridBody& body : found.bodies) CHECK(body.mesh.triangles.size() >= 12);
}
