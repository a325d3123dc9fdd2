#include "voxelize/mesh/winding.hpp"

#include <random>

#include <catch2/catch.hpp>

#include "tests/voxelize/shapes.hpp"
#include "voxelize/cells/winding_fill.hpp"

using namespace springlod;
using namespace springlod::voxelize;

namespace {

TriangleMesh sphere() {
  TriangleMesh mesh;
  test::add_sphere(mesh, "ball", Vec3::Zero(), 1, 40);
  return mesh;
}

/// The triangles without a fraction of them, drawn at random.
std::vector<Triangle> without(const std::vector<Triangle>& triangles, double fraction) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Triangle> kept;
  for (const Triangle& t : triangles)
    if (uniform(random) >= fraction) kept.push_back(t);
  return kept;
}

Vec3 any_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Vec3(normal(random), normal(random), normal(random)).normalized();
}

}  // namespace

TEST_CASE("The winding number of a closed surface is 1 inside and 0 outside") {
  const TriangleMesh mesh = sphere();
  const WindingNumber winding(mesh.positions, mesh.triangles);
  std::mt19937 random(1);
  for (const double radius : {0.0, 0.5, 0.9, 0.99, 1.01, 1.1, 2.0, 100.0})
    for (int i = 0; i < 100; ++i) {
      CAPTURE(radius);
      CHECK(winding.at(radius * any_direction(random)) == Approx(radius < 1 ? 1 : 0).margin(0.01));
    }
}

TEST_CASE("The winding number without a part of the surface is the fraction that is seen") {
  const TriangleMesh mesh = sphere();
  std::vector<Triangle> upper;
  for (const Triangle& t : mesh.triangles)
    if ((mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]).z() > 0)
      upper.push_back(t);
  CHECK(WindingNumber(mesh.positions, upper).at(Vec3::Zero()) == Approx(0.5).margin(0.01));
  const std::vector<Triangle> most = without(mesh.triangles, 0.1);
  CHECK(WindingNumber(mesh.positions, most).at(Vec3::Zero()) ==
        Approx(static_cast<double>(most.size()) / static_cast<double>(mesh.triangles.size()))
            .margin(0.03));
}

TEST_CASE("No triangles, and triangles without area, have the winding number 0") {
  CHECK(WindingNumber({}, {}).at(Vec3::Zero()) == 0);
  const std::vector<Vec3> line{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  CHECK(WindingNumber(line, std::vector<Triangle>{{0, 1, 2}}).at(Vec3(0, 1, 0)) == 0);
}

TEST_CASE("A surface with holes fills the cells of the closed one, except at the holes", "[long]") {
  const TriangleMesh mesh = sphere();
  const double missing = GENERATE(0.0, 0.001, 0.01, 0.05);
  const CellFrame frame = frame_around(bounds(mesh), 0.04);
  std::vector<Vec3> positions;
  for (const Vec3& p : mesh.positions) positions.push_back(frame.to_index(p));
  const std::vector<Triangle> triangles = without(mesh.triangles, missing);
  const auto cells = wound_cells(WindingNumber(positions, triangles), positions, triangles, frame);
  std::size_t inside = 0;
  for (std::uint32_t n = 0; n < frame.count(); ++n)
    inside += frame.center(frame.index(n)).norm() < 0.998 ? 1 : 0;  // between facets and sphere
  CAPTURE(missing);
  CHECK(static_cast<double>(cells.size()) ==
        Approx(static_cast<double>(inside)).epsilon(missing > 0 ? 0.01 : 0.005));
}
