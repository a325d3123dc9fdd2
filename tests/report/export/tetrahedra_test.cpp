#include "report/export/tetrahedra.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include <catch2/catch.hpp>

#include "model/mesh.hpp"
#include "tests/support/bodies.hpp"

using namespace springlod;
using namespace springlod::report;
using namespace springlod::test;
using voxelize::build_lattice;
using voxelize::LatticeStyle;

namespace {

constexpr double kEdge = 0.1;  // [m]

Material solid(const char* name, double young, double density, double poisson) {
  Material of = material(name, young, density, 0.001);
  of.poisson = poisson;
  return of;
}

// 3 x 2 x 4 cells without one, so that the body is not convex; the upper two layers are of the
// second material.
voxelize::MaterialGrid stepped(const std::vector<Material>& materials) {
  std::vector<Cell> cells;
  for (int z = 0; z < 4; ++z)
    for (int y = 0; y < 2; ++y)
      for (int x = 0; x < 3; ++x)
        if (x != 2 || y != 1 || z != 3)
          cells.push_back({{x, y, z}, static_cast<std::uint16_t>(z < 2 ? 0 : 1)});
  return grid_of(cells, kEdge, materials);
}

double volume_of(const MassSpringModel& model, const std::array<std::uint32_t, 4>& t) {
  const Vec3& at = model.rest[t[0]];
  return (model.rest[t[1]] - at).dot((model.rest[t[2]] - at).cross(model.rest[t[3]] - at)) / 6;
}

double centre_height(const MassSpringModel& model, const std::array<std::uint32_t, 4>& t) {
  return (model.rest[t[0]] + model.rest[t[1]] + model.rest[t[2]] + model.rest[t[3]]).z() / 4;
}

double mass_of(const MassSpringModel& model, const Tetrahedra& all) {
  const std::vector<double> density = density_of(model, all);
  double mass = 0;
  for (std::uint32_t t = 0; t < all.count(); ++t)
    mass += density[t] * volume_of(model, all.nodes[t]);
  return mass;
}

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

std::map<Triangle, int> uses_of_faces(const Tetrahedra& all) {
  std::map<Triangle, int> uses;
  for (const auto& [a, b, c, d] : all.nodes)
    for (Triangle face :
         {Triangle{a, b, c}, Triangle{a, b, d}, Triangle{a, c, d}, Triangle{b, c, d}}) {
      std::sort(face.begin(), face.end());
      ++uses[face];
    }
  return uses;
}

}  // namespace

TEST_CASE("six tetrahedra fill each cell of a corners lattice, and share its faces") {
  const auto grid = stepped({solid("stiff", 1e7, 1200, 0.25), solid("soft", 2e5, 900, 0.25)});
  const MassSpringModel model = build_lattice(grid).model;
  const Tetrahedra all = tetrahedra_of_cells(model);
  REQUIRE(all.count() == 6 * 23);
  CHECK(all.cell == Approx(kEdge));
  for (const auto& t : all.nodes) CHECK(volume_of(model, t) == Approx(kEdge * kEdge * kEdge / 6));

  int outer = 0;
  for (const auto& [face, count] : uses_of_faces(all)) {
    CHECK(count <= 2);
    outer += count == 1 ? 1 : 0;
  }
  // 2 (12 + 8 + 6) squares of the block; the missing cell takes three and adds three.
  CHECK(outer == 2 * 52);
}

TEST_CASE("tetrahedra have the material of their cell, whatever tells the materials apart") {
  const auto [first, second] =
      GENERATE(std::pair{solid("stiff", 1e7, 1200, 0.25), solid("soft", 2e5, 900, 0.25)},
               std::pair{solid("heavy", 1e6, 5000, 0.25), solid("light", 1e6, 500, 0.25)},
               std::pair{solid("light", 1e6, 500, 0.25), solid("heavy", 1e6, 5000, 0.25)},
               std::pair{solid("spread", 1e6, 1000, 0.45), solid("cork", 1e6, 1000, 0.0)},
               std::pair{solid("metal", 1e7, 1000, 0.3), solid("rubber", 1e5, 1000, 0.49)});
  const MassSpringModel model = build_lattice(stepped({first, second})).model;
  const Tetrahedra all = tetrahedra_of_cells(model);
  REQUIRE(all.count() == 6 * 23);
  const auto young = young_of(model, all), poisson = poisson_of(model, all),
             density = density_of(model, all);
  for (std::uint32_t t = 0; t < all.count(); ++t) {
    const Material& expected = centre_height(model, all.nodes[t]) < 2 * kEdge ? first : second;
    CHECK(young[t] == expected.young);
    CHECK(poisson[t] == expected.poisson);
    CHECK(density[t] == expected.density);
  }
  CHECK(mass_of(model, all) == Approx(total(model.mass)));
}

TEST_CASE("tetrahedra of cut cells are as soft and as light as the filled fraction") {
  auto grid = stepped({solid("stiff", 1e7, 1200, 0.3), solid("soft", 2e5, 900, 0.4)});
  grid.fraction.assign(grid.cells.size(), 1);
  grid.fraction[0] = 0.3F;
  grid.fraction[20] = 0.125F;
  const MassSpringModel model = build_lattice(grid).model;
  const Tetrahedra all = tetrahedra_of_cells(model);
  REQUIRE(all.count() == 6 * 23);
  CHECK(mass_of(model, all) == Approx(total(model.mass)));
  CHECK(std::count(all.fraction.begin(), all.fraction.end(), 1) == 6 * 21);
  const std::vector<double> young = young_of(model, all);
  CHECK(*std::min_element(young.begin(), young.end()) == Approx(0.125 * 2e5));
  CHECK(std::count_if(young.begin(), young.end(),
                      [](double e) { return e == Approx(0.3F * 1e7); }) == 6);
}

TEST_CASE("separated hinges leave cells whole") {
  const auto grid = grid_of({{{0, 0, 0}, 0}, {{1, 1, 0}, 0}}, kEdge, {solid("a", 1e6, 1000, 0.25)});
  const MassSpringModel model =
      build_lattice(grid, {.hinges = voxelize::HingePolicy::separate}).model;
  REQUIRE(model.node_count() == 16);
  CHECK(tetrahedra_of_cells(model).count() == 12);
}

TEST_CASE("models that are no cells have no tetrahedra, and a line says why") {
  const auto grid = stepped({solid("stiff", 1e7, 1200, 0.25), solid("soft", 2e5, 900, 0.25)});
  const MassSpringModel cells = build_lattice(grid).model;

  const auto centers = build_lattice(grid, {.style = LatticeStyle::centers}).model;
  CHECK(tetrahedra_of_cells(centers).empty());
  const auto bare = build_lattice(grid, {.volumes = false}).model;
  CHECK(tetrahedra_of_cells(bare).empty());
  CHECK_THAT(no_tetrahedra(bare), Catch::Contains("has no corners"));

  MassSpringModel moved = cells;
  moved.rest[5].x() += 0.01;
  CHECK(tetrahedra_of_cells(moved).empty());
  CHECK_THAT(no_tetrahedra(moved), Catch::Contains("level 0"));
  MassSpringModel holed = cells;
  holed.corners.erase(holed.corners.begin());
  CHECK(tetrahedra_of_cells(holed).empty());
}
