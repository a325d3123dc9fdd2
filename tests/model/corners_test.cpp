#include "model/corners.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "model/components.hpp"
#include "tests/support/lattices.hpp"
#include "tests/support/models.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::make_model;
using test::uniform;

/// A tetrahedron with a right angle at node 0, edges of 1, 2 and 3 m, all joined.
MassSpringModel right_corner() {
  MassSpringModel m = make_model({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}},
                                 {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
  m.corners = {{{0, 1, 2, 3}, 1e6}};
  return m;
}

/// Two cubes of 1 m, one above the other, each with one corner at node 0 or at node 8.
MassSpringModel two_corners() {
  MassSpringModel m = test::box_lattice(2, 2, 4);
  m.corners = {{{0, 1, 2, 4}, 1e6}, {{8, 9, 10, 12}, 2e6}};
  return m;
}

TEST_CASE("The volume and the shape of a corner") {
  const MassSpringModel m = right_corner();
  CHECK(corner_volume(m.corners[0], m.rest) == 6);
  CHECK(corner_shape(m.corners[0], m.rest) == 1);
  const Corner inverted{{0, 2, 1, 3}, 1e6};
  CHECK(corner_volume(inverted, m.rest) == -6);
  CHECK(corner_shape(inverted, m.rest) == -1);
  std::vector<Vec3> x = m.rest;
  x[3] = {3, 0, 3};  // at 45 degrees to the plane of the others
  CHECK(corner_shape(m.corners[0], x) == Approx(std::sqrt(0.5)));
  x[3] = {3, 4, 0};
  CHECK(corner_volume(m.corners[0], x) == 0);
  x[3] = x[0];
  CHECK(corner_shape(m.corners[0], x) == 0);
}

TEST_CASE("Corners that are turned over, flat or not finite are inverted") {
  const MassSpringModel m = two_corners();
  CHECK(inverted_corners(m.corners, m.rest).empty());
  std::vector<Vec3> x = m.rest;
  SECTION("turned over") {
    x[12].z() = x[8].z() - 0.1;
  }
  SECTION("flat") {
    x[12].z() = x[8].z();
  }
  SECTION("not finite") {
    x[12].z() = std::numeric_limits<double>::quiet_NaN();
  }
  CHECK(inverted_corners(m.corners, x) == std::vector<std::uint32_t>{1});
  for (Vec3& each : x) each.x() *= -1;  // a mirrored body is inverted everywhere but there
  if (x[12].z() < x[8].z()) CHECK(inverted_corners(m.corners, x) == std::vector<std::uint32_t>{0});
}

TEST_CASE("orient puts any order of neighbours into the standard form") {
  const MassSpringModel m = right_corner();
  std::array<std::uint32_t, 3> order{1, 2, 3};
  do {
    Corner corner{{0, order[0], order[1], order[2]}, 1e6};
    CHECK(orient(corner, m.rest));
    CHECK(corner == m.corners[0]);
  } while (std::next_permutation(order.begin(), order.end()));
  std::vector<Vec3> mirrored = m.rest;
  for (Vec3& x : mirrored) x.x() *= -1;
  Corner corner = m.corners[0];
  CHECK(orient(corner, mirrored));
  CHECK(corner.node == std::array<std::uint32_t, 4>{0, 1, 3, 2});
}

TEST_CASE("A corner is flat below a shape of kFlatCorner") {
  MassSpringModel m = right_corner();
  const auto lifted = [&](double shape) {
    m.rest[3] = {std::sqrt(1 - shape * shape), 0, shape};
    Corner corner = m.corners[0];
    return orient(corner, m.rest);
  };
  CHECK(lifted(1.001 * kFlatCorner));
  CHECK_FALSE(lifted(0.999 * kFlatCorner));
  CHECK_FALSE(lifted(0));
  m.rest[3] = m.rest[0];  // no length
  Corner corner = m.corners[0];
  CHECK_FALSE(orient(corner, m.rest));
}

TEST_CASE("settle_corners turns corners, drops flat ones and sorts the rest") {
  MassSpringModel m = two_corners();
  for (Vec3& x : m.rest) x.x() *= -1;
  m.corners.push_back({{1, 0, 3, 5}, 3e6});
  m.rest[12] = m.rest[8] + Vec3(-1, 0, 0.1);  // flattens the corner of node 8
  std::rotate(m.corners.begin(), m.corners.begin() + 2, m.corners.end());
  settle_corners(m.corners, m.rest);
  REQUIRE(m.corners.size() == 2);
  CHECK(m.corners[0] == Corner{{0, 1, 4, 2}, 1e6});
  CHECK(m.corners[1].node[0] == 1);
  CHECK_NOTHROW(validate(m));
}

TEST_CASE("An invalid corner is reported with its number and its rule") {
  struct Case {
    const char* named;
    const char* rule;
    std::function<void(MassSpringModel&)> damage;
  };
  const auto c = GENERATE(values<Case>({
      {"corner 2 (9 - 10, 100, 13)", "does not exist", [](auto& m) { m.corners[1].node[2] = 99; }},
      {"corner 1", "must differ", [](auto& m) { m.corners[0].node[3] = 1; }},
      {"corner 1", "no spring joins", [](auto& m) { m.corners[0].node[3] = 12; }},
      {"corner 1", "lowest neighbour",
       [](auto& m) {
         m.corners[0].node = {0, 2, 4, 1};
       }},
      {"corner 2", "sorted", [](auto& m) { std::swap(m.corners[0], m.corners[1]); }},
      {"corner 2", "none twice", [](auto& m) { m.corners[1] = m.corners[0]; }},
      {"corner 2", "modulus", [](auto& m) { m.corners[1].young = 0; }},
      {"corner 2", "modulus", [](auto& m) { m.corners[1].young = INFINITY; }},
      {"corner 2", "modulus", [](auto& m) { m.corners[1].young = NAN; }},
      {"corner 1", "volume",
       [](auto& m) { std::swap(m.corners[0].node[2], m.corners[0].node[3]); }},
      {"corner 1", "flat",
       [](auto& m) {
         m.rest[4] = {0.99, 0, 0.1};
       }},
  }));
  MassSpringModel m = two_corners();
  REQUIRE_NOTHROW(validate(m));
  c.damage(m);
  CHECK_THROWS_WITH(validate(m), Contains(c.named) && Contains(c.rule));
  CHECK_THROWS_AS(validate(m), InputError);
}

TEST_CASE("A moved, turned and scaled model keeps its corners valid") {
  MassSpringModel m = right_corner();
  // A corner at the bound itself: rounding must not decide.
  m.rest[3] = {std::sqrt(1 - kFlatCorner * kFlatCorner), 0, kFlatCorner};
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    m.rest_length[s] = (m.rest[m.b[s]] - m.rest[m.a[s]]).norm();
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const double scale : {1.0, 1e-4, 1.0 / 3, 123.4}) {
    MassSpringModel moved = m;
    for (Vec3& x : moved.rest) x = scale * (turn * x) + scale * Vec3(10, -20, 7);
    for (double& length : moved.rest_length) length *= scale;
    CHECK_NOTHROW(validate(moved));
  }
}

TEST_CASE("Components keep their corners") {
  // Two tetrahedra with interleaved node numbers.
  MassSpringModel m = make_model(
      {{0, 0, 0}, {9, 0, 0}, {1, 0, 0}, {10, 0, 0}, {0, 1, 0}, {9, 1, 0}, {0, 0, 1}, {9, 0, 1}},
      {{0, 2},
       {0, 4},
       {0, 6},
       {1, 3},
       {1, 5},
       {1, 7},
       {2, 4},
       {2, 6},
       {3, 5},
       {3, 7},
       {4, 6},
       {5, 7}});
  m.corners = {{{0, 2, 4, 6}, 1e6}, {{1, 3, 5, 7}, 2e6}};
  REQUIRE_NOTHROW(validate(m));
  const std::vector<ModelComponent> parts = split_components(m, connected_components(m));
  REQUIRE(parts.size() == 2);
  for (const ModelComponent& part : parts) CHECK_NOTHROW(validate(part.model));
  CHECK(parts[0].model.corners == std::vector<Corner>{{{0, 1, 2, 3}, 1e6}});
  CHECK(parts[1].model.corners == std::vector<Corner>{{{0, 1, 2, 3}, 2e6}});
}

TEST_CASE("J of a corner stays above kCornerResists while its nodes move by less than the margin") {
  std::mt19937_64 random(2);
  const auto vector = [&] {
    return Vec3(uniform(random) - 0.5, uniform(random) - 0.5, uniform(random) - 0.5);
  };
  // Each node moves by `distance` in a direction that lowers the volume.
  const auto pushed = [&](const std::vector<Vec3>& x, double distance) {
    const Vec3 gradient[3] = {(x[2] - x[0]).cross(x[3] - x[0]), (x[3] - x[0]).cross(x[1] - x[0]),
                              (x[1] - x[0]).cross(x[2] - x[0])};
    std::vector<Vec3> y = x;
    y[0] += distance * (gradient[0] + gradient[1] + gradient[2]).normalized();
    for (std::size_t i = 0; i < 3; ++i) y[i + 1] -= distance * gradient[i].normalized();
    return y;
  };
  const Mat3 turn = Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  int tried = 0;
  int reached = 0;
  double lowest = 1;
  while (tried < 20'000) {
    const std::vector<Vec3> rest{vector(), vector(), vector(), vector()};
    Corner corner{{0, 1, 2, 3}, 1};
    if (!orient(corner, rest)) continue;
    std::vector<Vec3> x = rest;  // stretched, squeezed and sheared
    for (Vec3& each : x) each = (0.5 + 2 * uniform(random)) * each + 0.5 * vector();
    std::vector<Vec3> ordered;
    for (const std::uint32_t node : corner.node) ordered.push_back(x[node]);
    const auto ratio = [&](const std::vector<Vec3>& of) {
      std::vector<Vec3> y(4);
      for (std::size_t i = 0; i < 4; ++i) y[corner.node[i]] = turn * of[i];
      return corner_volume(corner, y) / corner_volume(corner, rest);
    };
    const double margin = corner_margin(corner, rest, x);
    if (!(margin > 0)) {
      CHECK(ratio(ordered) <= kCornerResists + 1e-12);
      continue;
    }
    ++tried;
    lowest = std::min(lowest, ratio(pushed(ordered, margin)));
    for (Vec3& each : ordered) each += 0.001 * margin * vector();
    if (ratio(pushed(ordered, 6 * margin)) < kCornerResists) ++reached;
  }
  CHECK(lowest >= kCornerResists - 1e-12);
  CHECK(reached > tried / 2);
}

TEST_CASE("The margins of special corners") {
  const Corner corner{{0, 1, 2, 3}, 1e6};
  const std::vector<Vec3> cube{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}};
  CHECK(corner_margin(corner, cube, cube) == Approx(27.0 / 74 * 0.6 * 8 / 12));
  std::vector<Vec3> x = cube;
  x[3].z() = 4;  // J = 2
  CHECK(corner_margin(corner, cube, x) == Approx(27.0 / 74 * 1.6 * 8 / 24));
  x[3].z() = 0.8;
  CHECK(std::abs(corner_margin(corner, cube, x)) < 1e-15);
  x[3].z() = -1;
  CHECK(corner_margin(corner, cube, x) < 0);
  x[3].z() = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(corner_margin(corner, cube, x)));
}

}  // namespace
}  // namespace springlod
