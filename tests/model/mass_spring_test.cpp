#include "model/mass_spring.hpp"

#include <functional>
#include <limits>
#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "model/ranges.hpp"
#include "tests/support/lattices.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::box_lattice;
using test::make_model;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST_CASE("A valid model passes validate") {
  CHECK_NOTHROW(validate(box_lattice(3, 4, 5)));
  CHECK_NOTHROW(validate(make_model({{0, 0, 0}}, {})));
}

TEST_CASE("An invalid node or spring is reported with its number") {
  struct Case {
    const char* named;
    const char* rule;
    std::function<void(MassSpringModel&)> damage;
  };
  const auto c = GENERATE(values<Case>({
      {"node 8", "position", [](auto& m) { m.rest[7].y() = kNan; }},
      {"node 4", "mass", [](auto& m) { m.mass[3] = 0; }},
      {"node 4", "mass", [](auto& m) { m.mass[3] = kNan; }},
      {"node 3", "volume", [](auto& m) { m.volume[2] = -1; }},
      {"node 6", "contact area", [](auto& m) { m.contact_area[5] = -1e-9; }},
      {"node 6", "contact area is 1e+12 m2", [](auto& m) { m.contact_area[5] = 1e12; }},
      {"node 4", "mass is 1e+30 kg", [](auto& m) { m.mass[3] = 1e30; }},
      {"node 3", "volume is 1e+30 m3", [](auto& m) { m.volume[2] = 1e30; }},
      {"node 8", "position is 1e+300 m", [](auto& m) { m.rest[7].y() = 1e300; }},
      {"node 2", "border flag", [](auto& m) { m.border[1] = 2; }},
      {"node 7", "material", [](auto& m) { m.material[6] = 1; }},
      {"spring 5", "rest length", [](auto& m) { m.rest_length[4] = 0; }},
      {"spring 5", "rest length is 1e+308 m", [](auto& m) { m.rest_length[4] = 1e308; }},
      {"spring 5", "m for the distance of its nodes",
       [](auto& m) { m.rest_length[4] *= 1.01 * range::kMostCompression; }},
      {"spring 10", "stiffness is 1e+30 N/m", [](auto& m) { m.stiffness[9] = 1e30; }},
      {"spring 2", "N s/m for its stiffness",
       [](auto& m) { m.damping[1] = 1.01 * range::kDampingTime.most * m.stiffness[1]; }},
      {"spring 5", "nodes coincide", [](auto& m) { m.rest[m.b[4]] = m.rest[m.a[4]]; }},
      {"spring 10", "stiffness", [](auto& m) { m.stiffness[9] = -2; }},
      {"spring 10", "stiffness",
       [](auto& m) { m.stiffness[9] = std::numeric_limits<double>::infinity(); }},
      {"spring 2", "damping", [](auto& m) { m.damping[1] = kNan; }},
      {"spring 9", "does not exist", [](auto& m) { m.b[8] = 99; }},
      {"spring 1", "must differ", [](auto& m) { m.b[0] = m.a[0]; }},
      {"spring 7", "sorted", [](auto& m) { m.a[6] = m.a[5], m.b[6] = m.b[5]; }},
  }));
  MassSpringModel m = box_lattice(3, 3, 3);
  c.damage(m);
  CHECK_THROWS_WITH(validate(m), Contains(c.named) && Contains(c.rule));
}

TEST_CASE("Bodies from a cell of a nanometre to a planet are within the ranges") {
  // Of the softest gel and of diamond; the cells are those of 3 x 3 x 3 nodes.
  for (const double cell : {1e-9, 1e-3, 1.0, 5e6})
    for (const double young : {1.0, 1e12}) {
      CAPTURE(cell, young);
      MassSpringModel m = box_lattice(3, 3, 3, cell, young * cell);
      for (std::uint32_t i = 0; i < m.node_count(); ++i) {
        m.volume[i] = cell * cell * cell;
        m.mass[i] = 1000 * m.volume[i];
        m.contact_area[i] = 6 * cell * cell;
      }
      CHECK_NOTHROW(validate(m));
    }
}

TEST_CASE("Arrays of unequal length, no nodes and no materials are rejected") {
  MassSpringModel m = box_lattice(2, 2, 2);
  SECTION("nodes") {
    m.volume.pop_back();
  }
  SECTION("springs") {
    m.damping.pop_back();
  }
  SECTION("no nodes") {
    m = MassSpringModel{};
  }
  SECTION("no materials") {
    m.materials.clear();
  }
  SECTION("an invalid material") {
    m.materials[0].density = 0;
  }
  CHECK_THROWS_AS(validate(m), InputError);
}

TEST_CASE("Connected parts are numbered by their lowest node") {
  const MassSpringModel m = make_model(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, {{0, 4}, {1, 3}, {3, 5}});
  const Components components = connected_components(m);
  CHECK(components.count == 3);
  CHECK(components.of_node == std::vector<std::uint32_t>{0, 1, 2, 1, 0, 1});
  CHECK(connected_components(box_lattice(3, 3, 3)).count == 1);
}

TEST_CASE("mass_properties are those of the point masses") {
  MassSpringModel m = make_model({{0, 0, 0}, {4, 0, 0}}, {});
  m.mass = {1, 3};
  m.volume = {0.5, 0.25};
  m.border = {1, 0};
  const MassProperties p = mass_properties(m);
  CHECK(p.mass == 4);
  CHECK(p.volume == 0.75);
  CHECK((p.center - Vec3(3, 0, 0)).norm() < 1e-15);
  // 1 kg at 3 m and 3 kg at 1 m.
  CHECK((p.inertia - Vec3(0, 12, 12).asDiagonal().toDenseMatrix()).norm() < 1e-13);
  CHECK(border_count(m) == 1);

  for (Vec3& x : m.rest) x += Vec3(1e3, -2e3, 5e2);
  CHECK((mass_properties(m).inertia - p.inertia).norm() < 1e-9);
}

TEST_CASE("Eq. 2 of the paper gives E = 2.5 k / a inside a lattice") {
  // One inner node; half of its 18 springs belongs to its neighbours.
  const double a = 0.2;
  const double k = 300;
  MassSpringModel m = box_lattice(3, 3, 3, a, k / 2);
  const std::uint32_t inner = 13;
  MassSpringModel star = m;
  star.a.clear(), star.b.clear(), star.rest_length.clear(), star.stiffness.clear();
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    if (m.a[s] == inner || m.b[s] == inner) {
      star.a.push_back(m.a[s]);
      star.b.push_back(m.b[s]);
      star.rest_length.push_back(m.rest_length[s]);
      star.stiffness.push_back(m.stiffness[s]);
    }
  CHECK(star.spring_count() == 18);
  star.volume.assign(star.node_count(), 0);
  star.volume[inner] = a * a * a;
  CHECK(spring_work(star) == Approx(15 * k * a * a).epsilon(1e-12));
  CHECK(estimated_young(star) == Approx(2.5 * k / a).epsilon(1e-12));
}

TEST_CASE("The rest state has the rest positions and zero velocity") {
  const MassSpringModel m = box_lattice(2, 2, 2);
  const State state = rest_state(m);
  CHECK(state.x == m.rest);
  CHECK(state.v == std::vector<Vec3>(8, Vec3::Zero()));
  CHECK(state.t == 0);
}

}  // namespace
}  // namespace springlod
