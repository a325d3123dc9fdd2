#include "model/mesh.hpp"

#include <limits>

#include <catch2/catch.hpp>

#include "model/material.hpp"
#include "tests/support/assets.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;

TEST_CASE("Volume, area and bounds of a box do not depend on its position") {
  TriangleMesh box = test::box_mesh({1, 2, 3});
  box.parts = {{"box", "", 0, 12}};
  const Vec3 place = GENERATE(Vec3(0, 0, 0), Vec3(-1000, 500, 2000));
  for (Vec3& p : box.positions) p += place;
  CHECK(signed_volume(box, box.parts[0]) == Approx(6).epsilon(1e-9));
  CHECK(surface_area(box) == Approx(22).epsilon(1e-9));
  CHECK((bounds(box).min() - place).norm() == 0);
  CHECK((bounds(box).sizes() - Vec3(1, 2, 3)).norm() < 1e-12);

  for (Triangle& t : box.triangles) std::swap(t[0], t[1]);
  CHECK(signed_volume(box, box.parts[0]) == Approx(-6).epsilon(1e-9));
  CHECK(bounds(TriangleMesh{}).isEmpty());
}

TEST_CASE("An invalid mesh is rejected with the number of the vertex, triangle or part") {
  TriangleMesh box = test::box_mesh({1, 2, 3});
  CHECK_NOTHROW(validate(box));
  SECTION("vertex") {
    box.positions[5].x() = std::numeric_limits<double>::infinity();
    CHECK_THROWS_WITH(validate(box), Contains("vertex 6"));
  }
  SECTION("triangle") {
    box.triangles[7][2] = 8;
    CHECK_THROWS_WITH(validate(box), Contains("triangle 8") && Contains("vertex 9"));
  }
  SECTION("parts that leave a gap") {
    box.parts[1].first_triangle = 5;
    CHECK_THROWS_WITH(validate(box), Contains("sides"));
  }
  SECTION("parts that end early") {
    box.parts[1].triangle_count = 7;
    CHECK_THROWS_WITH(validate(box), Contains("11 of 12"));
  }
}

TEST_CASE("A material out of range is rejected with its name and the field") {
  Material m{.name = "rubber"};
  CHECK_NOTHROW(validate(m));
  SECTION("young") {
    m.young = 0;
  }
  SECTION("density") {
    m.density = -1;
  }
  SECTION("damping") {
    m.damping = std::numeric_limits<double>::quiet_NaN();
  }
  SECTION("young of no known matter") {
    m.young = 1e30;
  }
  SECTION("colour") {
    m.colour.g = 1.5F;
  }
  CHECK_THROWS_WITH(validate(m), Contains("rubber") && Contains("must lie between"));
  m.name.clear();
  CHECK_THROWS_WITH(validate(m), Contains("no name"));
}

TEST_CASE("Eight palette colours differ and then repeat") {
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(palette_colour(i) == palette_colour(j));
  CHECK(palette_colour(8) == palette_colour(0));
}

}  // namespace
}  // namespace springlod
