#include "model/binding.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/support/lattices.hpp"

namespace springlod {
namespace {

using Catch::Matchers::Contains;
using test::box_lattice;
using test::make_model;

/// Random points in the box, the same with every standard library.
std::vector<Vec3> points_in(const Box3& box, std::size_t count) {
  std::mt19937_64 random(7);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
    for (int d = 0; d < 3; ++d)
      p[d] = box.min()[d] + box.sizes()[d] * static_cast<double>(random() >> 11) * 0x1p-53;
  return points;
}

double largest_weight(const Binding& b) {
  double largest = 0;
  for (const double w : b.weight) largest = std::max(largest, std::abs(w));
  return largest;
}

double largest_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  REQUIRE(p.size() == q.size());
  double largest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) largest = std::max(largest, (p[i] - q[i]).norm());
  return largest;
}

/// A lattice whose nodes are displaced by up to a third of the spacing.
MassSpringModel uneven_lattice() {
  MassSpringModel m = box_lattice(5, 4, 6);
  const auto shifts = points_in(Box3(Vec3::Constant(-0.33), Vec3::Constant(0.33)), m.rest.size());
  for (std::size_t i = 0; i < m.rest.size(); ++i) m.rest[i] += shifts[i];
  return m;
}

TEST_CASE("Bound points follow every affine motion of the nodes exactly") {
  const MassSpringModel m = GENERATE(box_lattice(5, 4, 6), uneven_lattice());
  const auto points = points_in(Box3(Vec3(-0.5, -0.5, -0.5), Vec3(4.5, 3.5, 5.5)), 2000);
  const Binding b = bind_points(points, m);
  REQUIRE(b.point_count() == points.size());
  CHECK(largest_distance(interpolate(b, m.rest), points) < 1e-12);

  Mat3 map;
  map << 1.2, 0.1, -0.3, 0.4, 0.8, 0.2, -0.1, 0.5, 1.1;
  const Mat3 turn = Eigen::AngleAxisd(2.1, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (const Mat3& matrix : {map, turn}) {
    std::vector<Vec3> moved, expected;
    for (const Vec3& x : m.rest) moved.emplace_back(matrix * x + Vec3(1, -2, 3));
    for (const Vec3& p : points) expected.emplace_back(matrix * p + Vec3(1, -2, 3));
    CHECK(largest_distance(interpolate(b, moved), expected) < 1e-11);
  }
}

TEST_CASE("The weights of a bound point add up to 1, over at most eight nodes") {
  const MassSpringModel m = uneven_lattice();
  const auto points = points_in(Box3(Vec3(-0.5, -0.5, -0.5), Vec3(4.5, 3.5, 5.5)), 500);
  const Binding b = bind_points(points, m);
  for (std::uint32_t p = 0; p < b.point_count(); ++p) {
    double sum = 0;
    for (std::uint32_t e = b.start[p]; e < b.start[p + 1]; ++e) sum += b.weight[e];
    CHECK(sum == Approx(1).epsilon(1e-13));
    CHECK(b.start[p + 1] - b.start[p] <= kNodesPerPoint);
  }
}

TEST_CASE("A point at a node depends on that node alone, a point close to it almost so") {
  const MassSpringModel m = box_lattice(3, 3, 3, 0.1);
  const Binding on = bind_points({m.rest[13]}, m);
  CHECK(on.node == std::vector<std::uint32_t>{13});
  CHECK(on.weight == std::vector<double>{1});
  const Binding beside = bind_points({m.rest[13] + Vec3(1e-4, 2e-4, -1e-4)}, m);
  CHECK(beside.node[0] == 13);
  CHECK(beside.weight[0] == Approx(1).margin(0.01));
}

TEST_CASE("A point up to one spacing outside a lattice is reproduced with bounded weights") {
  const MassSpringModel m = box_lattice(4, 4, 4, 0.01);
  const double spacing = 0.01;
  const auto inside = points_in(Box3(Vec3::Zero(), Vec3::Constant(3 * spacing)), 3000);
  CHECK(largest_weight(bind_points(inside, m)) < 1.2);

  const auto around = points_in(Box3(Vec3::Constant(-spacing), Vec3::Constant(4 * spacing)), 20000);
  const Binding b = bind_points(around, m);
  CHECK(largest_distance(interpolate(b, m.rest), around) < 1e-12 * spacing * 10);
  CHECK(largest_weight(b) < 4);
}

TEST_CASE("A point far outside has finite, bounded weights") {
  const MassSpringModel m = uneven_lattice();
  const Binding b = bind_points({Vec3(1e6, 0, 0), Vec3(-40, 30, 20), Vec3(2, 2, 1e3)}, m);
  CHECK(largest_weight(b) < 30);
  for (const Vec3& p : interpolate(b, m.rest)) CHECK(p.norm() < 100);
}

TEST_CASE("A point between disconnected limbs is bound to the nearest one only") {
  // Two bars side by side, 0.6 spacings apart and without a spring between them.
  const MassSpringModel one = box_lattice(2, 2, 6);
  MassSpringModel two = one;
  const std::uint32_t n = one.node_count();
  for (const Vec3& x : one.rest) two.rest.emplace_back(x + Vec3(1.6, 0, 0));
  for (std::uint32_t s = 0; s < one.spring_count(); ++s) {
    two.a.push_back(one.a[s] + n);
    two.b.push_back(one.b[s] + n);
  }
  const Binding b = bind_points({Vec3(1.25, 0.5, 2.4), Vec3(1.35, 0.5, 2.4)}, two);
  REQUIRE(b.point_count() == 2);
  for (std::uint32_t e = b.start[0]; e < b.start[1]; ++e) CHECK(b.node[e] < n);
  for (std::uint32_t e = b.start[1]; e < b.start[2]; ++e) CHECK(b.node[e] >= n);
}

TEST_CASE("Coplanar, collinear and single nodes interpolate what they span, with finite weights") {
  SECTION("plane") {
    const MassSpringModel m = box_lattice(4, 4, 1);
    const Binding b = bind_points({Vec3(1.3, 2.2, 0.4)}, m);
    CHECK((interpolate(b, m.rest)[0] - Vec3(1.3, 2.2, 0)).norm() < 1e-12);
    CHECK(largest_weight(b) < 2);
  }
  SECTION("line") {
    const MassSpringModel m = test::chain_of_nodes(5);
    const Binding b = bind_points({Vec3(2.3, 0.2, -0.1)}, m);
    CHECK((interpolate(b, m.rest)[0] - Vec3(2.3, 0, 0)).norm() < 1e-12);
    CHECK(largest_weight(b) < 2);
  }
  SECTION("single node") {
    const MassSpringModel m = make_model({{1, 2, 3}, {9, 9, 9}}, {});
    const Binding b = bind_points({Vec3(1, 1, 1)}, m);
    CHECK(b.node == std::vector<std::uint32_t>{0});
    CHECK(b.weight == std::vector<double>{1});
  }
  SECTION("a plane whose nodes have neighbours outside it") {
    // Many nodes in a plane around the point, and a single layer far below.
    MassSpringModel m = box_lattice(5, 5, 2);
    for (Vec3& x : m.rest) x.z() *= 3;
    const Vec3 point(2.1, 1.9, 0.3);
    const Binding b = bind_points({point}, m);
    CHECK((interpolate(b, m.rest)[0] - point).norm() < 1e-12);
    CHECK(b.node.size() == 8);
  }
}

TEST_CASE("append_bound_point uses the given candidates, the nearest first, each once") {
  const MassSpringModel m = box_lattice(3, 3, 3);
  Binding b;
  const Vec3 point(0.4, 0.3, 0.2);
  append_bound_point(b, point, m, {13, 9, 3, 1, 0, 3});
  append_bound_point(b, m.rest[4], m, {4, 5, 1});
  REQUIRE(b.point_count() == 2);
  CHECK(b.node[0] == 0);
  CHECK(b.start[1] == 5);
  CHECK((interpolate(b, m.rest)[0] - point).norm() < 1e-13);
  CHECK_THROWS_AS(append_bound_point(b, point, m, {}), InputError);
}

TEST_CASE("A composed binding equals its two bindings in sequence") {
  const MassSpringModel coarse = box_lattice(3, 3, 3, 2);
  const MassSpringModel fine = uneven_lattice();
  const auto points = points_in(Box3(Vec3::Zero(), Vec3(4, 3, 5)), 200);
  const Binding inner = bind_points(fine.rest, coarse);
  const Binding outer = bind_points(points, fine);
  const Binding both = compose(outer, inner);
  std::vector<Vec3> moved = coarse.rest;
  for (Vec3& x : moved) x += Vec3(std::sin(x.y()), x.x() * x.z(), std::cos(x.x()));
  CHECK(largest_distance(interpolate(both, moved), interpolate(outer, interpolate(inner, moved))) <
        1e-12);
  for (std::uint32_t p = 0; p < both.point_count(); ++p)
    for (std::uint32_t e = both.start[p] + 1; e < both.start[p + 1]; ++e)
      REQUIRE(both.node[e - 1] < both.node[e]);
  CHECK_THROWS_AS(compose(outer, bind_points({Vec3::Zero()}, coarse)), InputError);
}

TEST_CASE("Binding rejects a model without nodes") {
  CHECK_THROWS_AS(bind_points({Vec3::Zero()}, MassSpringModel{}), InputError);
}

TEST_CASE("Weights that are large or do not add up to 1 are rejected with their point") {
  const auto two_points = [](const std::vector<double>& weight) {
    return Binding{{0, 1, 3}, {0, 1, 2}, weight};
  };
  CHECK_NOTHROW(validate(two_points({1, 1.5, -0.5}), 3));
  CHECK_THROWS_WITH(validate(two_points({1, -1.5, -0.5}), 3),
                    Contains("point 2") && Contains("add up to -2, not to 1"));
  CHECK_THROWS_WITH(validate(two_points({0.99, 1.5, -0.5}), 3), Contains("point 1"));
  CHECK_THROWS_WITH(validate(two_points({1, 1e6, 1 - 1e6}), 3), Contains("of entry 2"));
  CHECK_THROWS_WITH(validate(two_points({1, NAN, 1}), 3), Contains("of entry 2"));
}

}  // namespace
}  // namespace springlod
