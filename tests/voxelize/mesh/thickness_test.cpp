#include "voxelize/mesh/thickness.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/voxelize/shapes.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

double thickness_of(const TriangleMesh& mesh) {
  const auto solids = check_solid(mesh);
  REQUIRE(solids.size() == 1);
  return thickness(mesh, solids[0], solids[0].volume);
}

TriangleMesh box(const Vec3& size) {
  TriangleMesh mesh;
  add_box(mesh, "box", {1, 2, 3}, Vec3(1, 2, 3) + size);
  return mesh;
}

// A grid of points on the surface of a tube, closed both ways: `place(u, v)` with u and v in [0,
// 1).
template <class Place>
TriangleMesh torus_of(const Place& place, std::uint32_t around, std::uint32_t across) {
  std::vector<Vec3> positions;
  std::vector<Triangle> triangles;
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return (i % around) * across + j % across;
  };
  for (std::uint32_t i = 0; i < around; ++i)
    for (std::uint32_t j = 0; j < across; ++j) {
      positions.push_back(place(static_cast<double>(i) / around, static_cast<double>(j) / across));
      triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  TriangleMesh mesh;
  add_part(mesh, "ring", positions, triangles);
  return mesh;
}

}  // namespace

TEST_CASE("The thickness of plates and bars is their smallest side") {
  CHECK(thickness_of(box({10, 8, 0.5})) == Approx(0.5));
  CHECK(thickness_of(box({2, 2, 30})) == Approx(2));
  CHECK(thickness_of(box({4, 1, 30})) == Approx(1));
  CHECK(thickness_of(box({3, 3, 3})) == Approx(3));
}

TEST_CASE("The thickness of a ring of round section is its diameter") {
  const double pi = std::numbers::pi;
  const auto ring = torus_of(
      [&](double u, double v) {
        const double r = 5 + 0.7 * std::cos(2 * pi * v);
        return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 0.7 * std::sin(2 * pi * v));
      },
      60, 24);
  CHECK(thickness_of(ring) == Approx(1.4).epsilon(0.03));
}

TEST_CASE("The thickness of a hollow tube is its wall") {
  const double pi = std::numbers::pi;
  // Around the section: out along the outer face, back along the inner one.
  const auto tube = torus_of(
      [&](double u, double v) {
        const bool outer = v < 0.5;
        const double along = outer ? v / 0.5 : (1 - v) / 0.5;
        const double r = outer ? 2 : 1.8;
        return Vec3(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 10 * along);
      },
      48, 20);
  CHECK(thickness_of(tube) == Approx(0.2).epsilon(0.05));
}

TEST_CASE("The thickness of a closed box with a cavity is its wall") {
  TriangleMesh inner;
  add_box(inner, "box", {0.1, 0.1, 0.1}, {1.9, 1.9, 1.9});
  for (Triangle& t : inner.triangles) std::swap(t[1], t[2]);
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {2, 2, 2});
  add_part(mesh, "box", inner.positions, inner.triangles);
  CHECK(thickness_of(mesh) == Approx(0.1));
}

TEST_CASE("A solid that faces inwards has the same thickness, a sheet none") {
  TriangleMesh mesh = box({10, 8, 0.5});
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
  CHECK(thickness_of(mesh) == Approx(0.5));
  TriangleMesh sheet;
  add_part(sheet, "flag", {{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}}, {{0, 1, 2}, {0, 2, 3}});
  CHECK(thickness(sheet, check_solid(sheet)[0], 0) == 0);
  CHECK(thickness(sheet, check_solid(sheet)[0], 1e-3) == 0);
}

}  // namespace springlod::voxelize
