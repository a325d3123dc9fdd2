#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

/// A cube of one cell of the `corners` lattice: 1 m, E = 2.5 k / a with k = 4 N/m.
MassSpringModel unit_cell() {
  std::vector<Vec3> rest;
  for (int i = 0; i < 8; ++i) rest.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  std::vector<test::TableSpring> springs;
  for (std::uint32_t a = 0; a < 8; ++a)
    for (std::uint32_t b = a + 1; b < 8; ++b) {
      const double squared = (rest[b] - rest[a]).squaredNorm();
      if (squared < 2.5) springs.push_back({a, b, squared < 1.5 ? 1.0 : 2.0});
    }
  return test::table_model(rest, std::vector<double>(8, 125), springs);
}

std::vector<Vec3> corner_areas(const MassSpringModel& model) {
  std::vector<Vec3> areas;
  for (const Vec3& p : model.rest) areas.emplace_back((2 * p - Vec3::Ones()) / 4);
  return areas;
}

TEST_CASE("A cell of the lattice under uniform stress has exactly its E and nu") {
  const MassSpringModel cell = unit_cell();
  const SurfaceStretchResult r = surface_stretch(cell, corner_areas(cell));
  CHECK(r.young == Approx(10).epsilon(1e-6));
  CHECK(r.poisson == Approx(0.25).margin(1e-6));
}

TEST_CASE("Too few areas, and areas that enclose nothing, are rejected") {
  const MassSpringModel cell = unit_cell();
  CHECK_THROWS_AS(surface_stretch(cell, {}), InputError);
  CHECK_THROWS_AS(surface_stretch(cell, std::vector<Vec3>(8, Vec3::Zero())), InputError);
}

}  // namespace
}  // namespace springlod::elastic
