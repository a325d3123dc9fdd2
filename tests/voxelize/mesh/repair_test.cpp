#include "voxelize/mesh/repair.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/weld.hpp"

using namespace springlod;
using namespace springlod::voxelize;
using Catch::Matchers::Contains;

namespace {

TriangleMesh box() {
  TriangleMesh mesh;
  test::add_box(mesh, "box", Vec3::Zero(), {1, 2, 3});
  return mesh;
}

RepairedMesh mended(const TriangleMesh& mesh) {
  const auto welded = weld_vertices(mesh);
  return repair(mesh, check_solid(mesh, welded), welded);
}

void remove(TriangleMesh& mesh, std::size_t triangle) {
  mesh.triangles.erase(mesh.triangles.begin() + static_cast<std::ptrdiff_t>(triangle));
  --mesh.parts[0].triangle_count;
}

void add(TriangleMesh& mesh, const Triangle& triangle) {
  mesh.triangles.push_back(triangle);
  ++mesh.parts[0].triangle_count;
}

std::size_t cells_of(const TriangleMesh& mesh, Repair how = Repair::automatic) {
  VoxelizeOptions options;
  options.cell = 0.1;
  options.repair = how;
  return voxelize::voxelize(mesh, options).grid.cells.size();
}

}  // namespace

TEST_CASE("A faultless mesh is not changed by repair") {
  const TriangleMesh mesh = box();
  const RepairedMesh same = mended(mesh);
  CHECK(same.mesh.triangles == mesh.triangles);
  CHECK(same.solids.at(0).volume == Approx(6));
  CHECK(describe(same.solids[0]).empty());
}

TEST_CASE("Holes are counted and measured, and closed in the grid") {
  TriangleMesh mesh = box();
  remove(mesh, 10);
  remove(mesh, 8);  // half of the right side and half of the left one
  const SolidRepair repair = mended(mesh).solids.at(0);
  CHECK(repair.open_edges == 6);
  CHECK(repair.holes == 2);
  CHECK(repair.hole_area == Approx(3 + 3));
  CHECK(repair.volume == Approx(6));
  CHECK_THAT(describe(repair).at(0), Contains("open edge") && Contains("closed"));
  CHECK(cells_of(mesh) == Approx(6000).epsilon(0.2));
  CHECK_THROWS_WITH(cells_of(mesh, Repair::strict), Contains("needs repair"));
  CHECK_THROWS_WITH(cells_of(mesh, Repair::off), Contains("is not closed"));
}

TEST_CASE("Triangles against their neighbours are turned") {
  TriangleMesh mesh = box();
  for (const std::size_t t : {1U, 5U}) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  const RepairedMesh turned = mended(mesh);
  CHECK(turned.solids.at(0).turned == 2);
  CHECK(turned.mesh.triangles == box().triangles);
  CHECK(cells_of(mesh) == 6000);
}

TEST_CASE("Most of the triangles facing inwards, all are turned outwards") {
  TriangleMesh mesh = box();
  test::turn_inside_out(mesh, mesh.parts[0]);
  std::swap(mesh.triangles[2][1], mesh.triangles[2][2]);
  const RepairedMesh turned = mended(mesh);
  CHECK(turned.solids.at(0).inside_out);
  CHECK(turned.solids.at(0).volume == Approx(6));
  CHECK(turned.mesh.triangles == box().triangles);
}

TEST_CASE("Doubled triangles are removed, however their corners are ordered") {
  TriangleMesh mesh = box();
  add(mesh, mesh.triangles[3]);
  add(mesh, {mesh.triangles[7][1], mesh.triangles[7][0], mesh.triangles[7][2]});
  const RepairedMesh single = mended(mesh);
  CHECK(single.solids.at(0).doubled == 2);
  CHECK(single.mesh.triangles == box().triangles);
  CHECK(single.mesh.parts.at(0).triangle_count == 12);
  CHECK_THAT(describe(single.solids[0]).at(0), Contains("2 doubled triangles removed"));
}

TEST_CASE("A sheet encloses nothing, and is refused or named") {
  TriangleMesh mesh;
  test::add_part(mesh, "flag", {{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}},
                 {{0, 1, 2}, {0, 2, 3}});
  CHECK_THROWS_AS(cells_of(mesh), InputError);
  test::add_box(mesh, "box", Vec3::Zero(), {1, 1, 1});
  VoxelizeOptions options;
  options.cell = 0.1;
  const VoxelizedMesh both = voxelize::voxelize(mesh, options);
  CHECK(both.grid.cells.size() == 1000);
  REQUIRE(both.report.warnings.size() == 1);
  CHECK_THAT(both.report.warnings[0], Contains("\"flag\" is lost"));
}

TEST_CASE("A plate too thin for the cells is named with a cell that resolves it") {
  TriangleMesh mesh;
  test::add_box(mesh, "plate", Vec3::Zero(), {1, 1, 0.01});
  VoxelizeOptions options;
  options.cell = 0.1;
  const VoxelizedMesh thick = voxelize::voxelize(mesh, options);
  REQUIRE(thick.report.warnings.size() == 1);
  CHECK_THAT(thick.report.warnings[0], Contains("it is about 10 mm thick: use a cell of 3.333 mm"));
  options.repair = Repair::strict;
  CHECK_THROWS_WITH(voxelize::voxelize(mesh, options),
                    Contains("it is about 10 mm thick: use a cell of 3.333 mm"));
}

TEST_CASE("A sphere without some triangles has the volume of the whole one within 2 %") {
  TriangleMesh whole;
  test::add_sphere(whole, "ball", Vec3::Zero(), 1);
  const double missing = GENERATE(0.001, 0.01, 0.05);
  const unsigned seed = GENERATE(1U, 2U, 3U);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(0, 1);
  TriangleMesh mesh;
  mesh.positions = whole.positions;
  for (const Triangle& t : whole.triangles)
    if (uniform(random) >= missing) mesh.triangles.push_back(t);
  mesh.parts = whole.parts;
  mesh.parts[0].triangle_count = static_cast<std::uint32_t>(mesh.triangles.size());
  CAPTURE(missing, seed);
  CHECK(static_cast<double>(cells_of(mesh)) ==
        Approx(static_cast<double>(cells_of(whole))).epsilon(0.02));
}

TEST_CASE("A cavity stays empty in a solid with a hole") {
  TriangleMesh mesh;
  test::add_sphere(mesh, "ball", Vec3::Zero(), 1);
  const MeshPart inner{"ball", "", mesh.parts[0].triangle_count, mesh.parts[0].triangle_count};
  test::add_sphere(mesh, "ball", Vec3::Zero(), 0.5);
  test::turn_inside_out(mesh, inner);
  const std::size_t hollow = cells_of(mesh);
  mesh.triangles.erase(mesh.triangles.begin() + 100);
  --mesh.parts[0].triangle_count;
  --mesh.parts[1].first_triangle;
  CHECK(static_cast<double>(cells_of(mesh)) == Approx(static_cast<double>(hollow)).epsilon(0.01));
}
