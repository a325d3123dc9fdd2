#include "voxelize/mesh/solid.hpp"

#include <catch2/catch.hpp>

#include "tests/voxelize/shapes.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

// A box whose triangles from number `split` on form a second part.
TriangleMesh split_box(const std::string& first, const std::string& second, std::size_t split) {
  TriangleMesh mesh;
  const auto corners = box_corners({0, 0, 0}, {1, 2, 3});
  const auto all = box_triangles();
  add_part(mesh, first, corners, {all.begin(), all.begin() + static_cast<long>(split)}, "red");
  add_part(mesh, second, corners, {all.begin() + static_cast<long>(split), all.end()}, "blue");
  return mesh;
}

}  // namespace

TEST_CASE("A box is a closed solid with its volume") {
  TriangleMesh mesh;
  add_box(mesh, "box", {1e3, 0, 0}, {1e3 + 1, 2, 3});
  const auto reports = check_solid(mesh);
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].part == "box");
  CHECK(reports[0].closed());
  CHECK(reports[0].nonmanifold_edges == 0);
  CHECK(reports[0].volume == Approx(6));
}

TEST_CASE("A sphere of separate triangles rounded to single precision is closed") {
  TriangleMesh sphere;
  add_sphere(sphere, "ball", {0.3, 0.2, 0.1}, 1);
  TriangleMesh soup;
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  for (const Triangle& t : sphere.triangles) {
    const auto base = static_cast<std::uint32_t>(positions.size());
    // Neighbouring triangles are rounded differently.
    const double wobble = triangles.size() % 2 == 0 ? 1 + 3e-8 : 1 - 3e-8;
    for (const std::uint32_t v : t)
      positions.emplace_back((sphere.positions[v] * wobble).cast<float>().cast<double>());
    triangles.push_back({base, base + 1, base + 2});
  }
  add_part(soup, "ball", positions, triangles);
  const auto reports = check_solid(soup);
  CHECK(reports[0].closed());
  CHECK(reports[0].nonmanifold_edges == 0);
}

TEST_CASE("A box without its lid has four boundary edges") {
  TriangleMesh mesh;
  auto triangles = box_triangles();
  triangles.erase(triangles.begin() + 2, triangles.begin() + 4);
  add_part(mesh, "pot", box_corners({0, 0, 0}, {1, 2, 3}), triangles);
  const auto reports = check_solid(mesh);
  CHECK_FALSE(reports[0].closed());
  CHECK(reports[0].boundary_edges == 4);
  CHECK(reports[0].first_hole.z() == 3);
}

TEST_CASE("An object of two materials is one closed solid of two parts") {
  const auto reports = check_solid(split_box("box", "box", 5));
  REQUIRE(reports.size() == 1);
  CHECK(reports[0].parts == std::vector<std::uint32_t>{0, 1});
  CHECK(reports[0].closed());
  CHECK(reports[0].volume == Approx(6));
}

TEST_CASE("Open parts of different names with a common boundary form one solid") {
  TriangleMesh mesh = split_box("pot", "lid", 7);
  add_box(mesh, "beside", {1, 0, 0}, {2, 2, 3});
  const auto reports = check_solid(mesh);
  REQUIRE(reports.size() == 2);
  CHECK(reports[0].part == "pot");
  CHECK(reports[0].parts == std::vector<std::uint32_t>{0, 1});
  CHECK(reports[0].closed());
  CHECK(reports[1].part == "beside");
  CHECK(reports[1].volume == Approx(6));
}

TEST_CASE("Closed parts that share a face remain separate solids") {
  TriangleMesh mesh;
  add_box(mesh, "left", {0, 0, 0}, {1, 1, 1});
  add_box(mesh, "right", {1, 0, 0}, {2, 1, 1});
  CHECK(check_solid(mesh).size() == 2);
}

TEST_CASE("An inverted box has a negative volume, one reversed triangle gives non-manifold edges") {
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {1, 1, 1});
  std::swap(mesh.triangles[4][1], mesh.triangles[4][2]);
  CHECK(check_solid(mesh)[0].nonmanifold_edges == 3);
  CHECK(check_solid(mesh)[0].closed());
  std::swap(mesh.triangles[4][1], mesh.triangles[4][2]);
  turn_inside_out(mesh, mesh.parts[0]);
  CHECK(check_solid(mesh)[0].volume == Approx(-1));
  CHECK(check_solid(mesh)[0].nonmanifold_edges == 0);
}

TEST_CASE("A wall inside a box gives edges with three triangles") {
  TriangleMesh mesh;
  auto triangles = box_triangles();
  triangles.push_back({0, 1, 7});  // one half of a diagonal wall through the box
  triangles.push_back({0, 7, 6});
  add_part(mesh, "box", box_corners({0, 0, 0}, {1, 1, 1}), triangles);
  CHECK(check_solid(mesh)[0].nonmanifold_edges >= 2);
}

}  // namespace springlod::voxelize
