#include "elastic/zero_modes.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "elastic/stiffness.hpp"
#include "tests/support/lattices.hpp"

namespace springlod::elastic {
namespace {

using test::box_lattice;
using test::make_model;

MassSpringModel tetrahedron() {
  return make_model({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}});
}

/// The model with an additional node at `place`, connected to `to`.
MassSpringModel with_node(const MassSpringModel& m, const Vec3& place,
                          const std::vector<std::uint32_t>& to) {
  std::vector<Vec3> points = m.rest;
  std::vector<test::Pair> pairs;
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) pairs.emplace_back(m.a[s], m.b[s]);
  for (const std::uint32_t node : to) pairs.emplace_back(node, m.node_count());
  points.push_back(place);
  std::sort(pairs.begin(), pairs.end());
  return make_model(points, pairs);
}

std::uint32_t dense_count(const MassSpringModel& m) {
  const Eigen::MatrixXd k = stiffness_matrix(m);
  const auto values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k, Eigen::EigenvaluesOnly).eigenvalues();
  return static_cast<std::uint32_t>((values.array() < 1e-10 * values.maxCoeff()).count());
}

TEST_CASE("A tetrahedron of springs has six zero modes") {
  const auto parts = zero_modes(tetrahedron());
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].zero_modes == 6);
  CHECK(parts[0].expected == 6);
  CHECK(parts[0].mechanism_nodes.empty());
}

TEST_CASE("A single node has three zero modes, two nodes on a spring have five") {
  const auto parts = zero_modes(make_model({{0, 0, 0}, {5, 5, 5}, {6, 5, 5}}, {{1, 2}}));
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].node_count == 1);
  CHECK(parts[0].zero_modes == 3);
  CHECK(parts[0].expected == 3);
  CHECK(parts[1].first_node == 1);
  CHECK(parts[1].zero_modes == 5);
  CHECK(parts[1].expected == 5);
  CHECK(parts[1].mechanism_nodes.empty());
}

TEST_CASE("A straight chain resists only longitudinal motions") {
  const std::uint32_t n = GENERATE(3U, 10U, 500U);
  const auto parts = zero_modes(test::chain_of_nodes(n));
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].expected == 5);
  CHECK(parts[0].zero_modes == 3 * n - (n - 1));
  CHECK(parts[0].mechanism_nodes.size() == n);
}

TEST_CASE("A straight line of fully connected nodes resists only longitudinal motions") {
  // All pairs of nodes of a line are connected: in linear theory that adds no lateral stiffness.
  std::vector<test::Pair> pairs;
  for (std::uint32_t a = 0; a < 4; ++a)
    for (std::uint32_t b = a + 1; b < 4; ++b) pairs.emplace_back(a, b);
  const auto parts = zero_modes(make_model({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, pairs));
  CHECK(parts[0].expected == 5);
  CHECK(parts[0].zero_modes == 9);
}

TEST_CASE("A square frame has mechanisms: it shears and folds") {
  const auto parts = zero_modes(
      make_model({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1}, {0, 3}, {1, 2}, {2, 3}}));
  CHECK(parts[0].expected == 6);
  CHECK(parts[0].zero_modes == 8);
  CHECK(parts[0].mechanism_nodes.size() == 4);
}

TEST_CASE("A loose node is listed, and no other node") {
  const MassSpringModel sound = box_lattice(3, 3, 3);
  SECTION("on one spring") {
    const auto parts = zero_modes(with_node(sound, {3, 1, 1}, {14}));
    CHECK(parts[0].zero_modes == 8);
    CHECK(parts[0].mechanism_nodes == std::vector<std::uint32_t>{27});
  }
  SECTION("on springs in one plane") {
    const auto parts = zero_modes(with_node(sound, {3, 1, 1}, {11, 14, 17}));
    CHECK(parts[0].zero_modes == 7);
    CHECK(parts[0].mechanism_nodes == std::vector<std::uint32_t>{27});
  }
  SECTION("on springs in all directions it is not loose") {
    const auto parts = zero_modes(with_node(sound, {3, 1, 1}, {5, 11, 14, 17}));
    CHECK(parts[0].zero_modes == 6);
    CHECK(parts[0].mechanism_nodes.empty());
  }
}

TEST_CASE("The node with the largest motion comes first") {
  MassSpringModel m = with_node(box_lattice(3, 3, 3), {3, 1, 1}, {14});
  m = with_node(m, {4, 1, 1}, {27});
  const auto parts = zero_modes(m);
  CHECK(parts[0].zero_modes == 10);
  CHECK(parts[0].mechanism_nodes.size() == 2);
}

TEST_CASE("Mechanisms do not depend on the stiffness of the springs") {
  MassSpringModel m = with_node(box_lattice(4, 3, 3), {4, 1, 1}, {15, 19});
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) m.stiffness[s] = s % 2 == 0 ? 1e-6 : 1e9;
  const auto parts = zero_modes(m);
  CHECK(parts[0].zero_modes == 7);
}

TEST_CASE("Counts agree with a dense eigenvalue solver on lattices with missing springs") {
  const MassSpringModel whole = box_lattice(4, 3, 3);
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    // Between a tenth and two thirds of the springs are removed.
    std::vector<test::Pair> pairs;
    std::uint32_t draw = seed * 2654435761U;
    for (std::uint32_t s = 0; s < whole.spring_count(); ++s) {
      draw = draw * 1664525U + 1013904223U;
      if ((draw >> 8) % 18 > seed) pairs.emplace_back(whole.a[s], whole.b[s]);
    }
    const MassSpringModel m = make_model(whole.rest, pairs);
    std::uint32_t count = 0;
    for (const ComponentModes& part : zero_modes(m)) {
      count += part.zero_modes;
      CHECK((part.zero_modes > part.expected) == !part.mechanism_nodes.empty());
    }
    INFO("seed " << seed << ", " << pairs.size() << " springs");
    CHECK(count == dense_count(m));
  }
}

}  // namespace
}  // namespace springlod::elastic
