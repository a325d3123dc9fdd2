// Anchored bodies: modes, static loads, and the motions that the anchors leave free.

#include "model/anchors.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/zero_modes.hpp"
#include "model/chain.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

using Nodes = std::vector<std::uint32_t>;

/// Nodes of a box whose z is below `height`.
Nodes nodes_below(const MassSpringModel& model, double height) {
  Nodes nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (model.rest[i].z() < height) nodes.push_back(i);
  return nodes;
}

StaticLoad no_load(const MassSpringModel& model) {
  return {"test", std::vector<Vec3>(model.node_count(), Vec3::Zero())};
}

TEST_CASE("Anchored rows of masses have the analytical frequencies") {
  const std::uint32_t n = GENERATE(7U, 150U);
  const double k = 40;
  const MassSpringModel row = test::chain_of_nodes(n, k);  // masses of 1
  const auto omega = [&](double waves) {
    return 2 * std::sqrt(k) * std::sin(std::numbers::pi * waves / 2);
  };
  SECTION("held at one end") {
    const Modes found = lowest_modes(elastic_body(row, {.anchored = Nodes{0}}), {.count = 4});
    CHECK(found.zero_modes_skipped == 2 * (n - 1));  // all lateral motions
    REQUIRE(found.modes.size() == 4);
    for (std::size_t j = 0; j < 4; ++j) {
      const double waves = (2.0 * static_cast<double>(j) + 1) / (2.0 * (n - 1) + 1);
      CHECK(found.modes[j].angular_frequency == Approx(omega(waves)).epsilon(1e-7));
      CHECK(found.modes[j].shape[0] == Vec3::Zero());
    }
  }
  SECTION("held at both ends") {
    const Modes found =
        lowest_modes(elastic_body(row, {.anchored = Nodes{n - 1, 0}}), {.count = 4});
    for (std::size_t j = 0; j < 4; ++j)
      CHECK(found.modes[j].angular_frequency ==
            Approx(omega((static_cast<double>(j) + 1) / (n - 1))).epsilon(1e-7));
  }
  SECTION("held in the middle, the halves vibrate independently") {
    const Modes found = lowest_modes(elastic_body(row, {.anchored = Nodes{n / 3}}), {.count = 2});
    const std::uint32_t shorter = n / 3, longer = n - 1 - shorter;  // free masses
    const auto side = [&](std::uint32_t moving, double wave) {
      return omega(wave / (2.0 * moving + 1));
    };
    CHECK(found.modes[0].angular_frequency == Approx(side(longer, 1)).epsilon(1e-7));
    CHECK(found.modes[1].angular_frequency ==
          Approx(std::min(side(shorter, 1), side(longer, 3))).epsilon(1e-7));
  }
}

TEST_CASE("Modes and compliances of a held body are those of a dense solver") {
  const MassSpringModel model = test::random_model(3, GENERATE(4, 6));
  const Nodes anchored = nodes_below(model, 0.9);
  const ElasticBody body = elastic_body(model, {.anchored = anchored});
  CHECK(body.zero_mode_count() == 0);
  CHECK(body.anchored.nodes == anchored);

  const std::vector<std::uint8_t> held = anchor_flags(model, anchored);
  const Eigen::MatrixXd all = stiffness_matrix(model);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if (held[static_cast<std::size_t>(i / 3)] == 0) rows.push_back(i);
  const Eigen::MatrixXd stiffness = all(rows, rows);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.rows());
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    mass(i, i) = model.mass[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)] / 3)];
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(stiffness, mass);

  const Modes found = lowest_modes(body, {.count = 15});
  CHECK(found.zero_modes_skipped == 0);
  for (std::size_t j = 0; j < found.modes.size(); ++j)
    CHECK(found.modes[j].angular_frequency ==
          Approx(std::sqrt(dense.eigenvalues()[static_cast<Eigen::Index>(j)])).epsilon(1e-6));

  StaticLoad load = no_load(model);
  for (std::size_t i = 0; i < load.force.size(); ++i)
    load.force[i] = Vec3(1, 0.1 * static_cast<double>(i % 7), -0.5);
  const StaticSolution solution = solve_static(body, {load}).at(0);
  const Eigen::VectorXd force = test::flatten(load.force)(rows);
  const Eigen::VectorXd expected = stiffness.ldlt().solve(force);
  CHECK((test::flatten(solution.displacement)(rows) - expected).norm() < 1e-9 * expected.norm());
  CHECK(solution.compliance == Approx(force.dot(expected)).epsilon(1e-9));
  for (const std::uint32_t node : anchored) CHECK(solution.displacement[node] == Vec3::Zero());
}

TEST_CASE("Springs of a support are on the diagonal of the stiffness") {
  const MassSpringModel model = test::random_model(3, 4);
  Support support(nodes_below(model, 0.3));
  const auto high = model.node_count() - 1;
  support.springs = {{high, 30}, {high - 3, 50}, {high, 20}};
  const bool held = GENERATE(true, false);
  if (!held) support.nodes.clear();
  if (!held) support.springs.push_back({0, 40});
  const ElasticBody body = elastic_body(model, {.anchored = support});
  CHECK(body.zero_mode_count() == 0);

  Eigen::MatrixXd all = stiffness_matrix(model);
  for (const NodeSpring& spring : support.springs)
    for (int d = 0; d < 3; ++d) all(3 * spring.node + d, 3 * spring.node + d) += spring.stiffness;
  const std::vector<std::uint8_t> is_held = anchor_flags(model, support.nodes);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if (is_held[static_cast<std::size_t>(i / 3)] == 0) rows.push_back(i);
  const Eigen::MatrixXd stiffness = all(rows, rows);
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(stiffness.rows(), stiffness.rows());
  for (Eigen::Index i = 0; i < mass.rows(); ++i)
    mass(i, i) = model.mass[static_cast<std::size_t>(rows[static_cast<std::size_t>(i)] / 3)];
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> dense(stiffness, mass);
  const Modes found = lowest_modes(body, {.count = 10});
  for (std::size_t j = 0; j < found.modes.size(); ++j)
    CHECK(found.modes[j].angular_frequency ==
          Approx(std::sqrt(dense.eigenvalues()[static_cast<Eigen::Index>(j)])).epsilon(1e-6));

  StaticLoad load = no_load(model);
  for (std::size_t i = 0; i < load.force.size(); ++i)
    load.force[i] = Vec3(1, 0.1 * static_cast<double>(i % 7), -0.5);
  const StaticSolution solution = solve_static(body, {load}).at(0);
  const Eigen::VectorXd expected = stiffness.ldlt().solve(test::flatten(load.force)(rows));
  CHECK((test::flatten(solution.displacement)(rows) - expected).norm() < 1e-9 * expected.norm());
}

TEST_CASE("Springs that leave motions free, or are none, are found") {
  const MassSpringModel box = test::box_lattice(4, 4, 4);
  CHECK(elastic_body(box, {.anchored = {{}, {{0, 5}}}}).zero_mode_count() == 3);
  CHECK(elastic_body(box, {.anchored = {Nodes{0}, {{1, 5}}}}).zero_mode_count() == 1);
  CHECK_THROWS_WITH(elastic_body(box, {.anchored = {{}, {{70, 5}}}}),
                    Catch::Matchers::Contains("no node 71"));
  CHECK_THROWS_WITH(elastic_body(box, {.anchored = {{}, {{3, -5}}}}),
                    Catch::Matchers::Contains("the spring of node 4 has a stiffness of -5 N/m"));
}

TEST_CASE("A bar hanging from one end has the elongation of its material") {
  // The held end cannot contract, which stiffens it. Far from it the strain is that of the
  // material.
  const double young = 3e6, a = 0.01;
  const int cells = 2, along = 24;
  const MassSpringModel bar = test::corners_box(cells, cells, along, a, young, 1000);
  StaticLoad load = no_load(bar);
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    if (bar.rest[i].z() > (along - 0.5) * a) {
      const auto edges = [&](int d) { return std::abs(bar.rest[i][d] - a) > a / 2 ? 0.5 : 1.0; };
      load.force[i].z() = edges(0) * edges(1) / (cells * cells);
    }
  const StaticSolution solution =
      solve_static(elastic_body(bar, {.anchored = nodes_below(bar, a / 2)}), {load}).at(0);
  const auto height = [&](std::size_t layer) { return solution.displacement[layer * 9].z(); };
  const double strain = 1 / (young * std::pow(cells * a, 2));
  CHECK((height(24) - height(12)) / (12 * a) == Approx(strain).epsilon(1e-4));
  CHECK(height(24) < strain * along * a);  // the held end is stiffer
  CHECK(height(24) > 0.97 * strain * along * a);
}

/// Deflection of the end of a cantilever of square section under a unit load across it.
double tip_deflection(int cells, double thick, double length, double young) {
  const double a = thick / cells;
  const MassSpringModel bar =
      test::corners_box(cells, cells, static_cast<int>(std::lround(length / a)), a, young, 1000);
  StaticLoad load = no_load(bar);
  const Nodes inner = nodes_below(bar, length - a / 2);
  const std::vector<std::uint8_t> is_inner = anchor_flags(bar, inner);
  double nodes = std::pow(cells + 1, 2), sum = 0;
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    if (is_inner[i] == 0) load.force[i].x() = 1 / nodes;
  const StaticSolution solution =
      solve_static(elastic_body(bar, {.anchored = nodes_below(bar, a / 2)}), {load}).at(0);
  for (std::uint32_t i = 0; i < bar.node_count(); ++i)
    if (is_inner[i] == 0) sum += solution.displacement[i].x() / nodes;
  return sum;
}

TEST_CASE("The deflection of a cantilever converges to Timoshenko's with finer cells") {
  const double young = 2e6, thick = 0.1, length = 1, nu = 0.25;
  const double shear = young / (2 * (1 + nu)), area = thick * thick;
  const double expected = std::pow(length, 3) / (3 * young * std::pow(thick, 4) / 12) +
                          length / (10 * (1 + nu) / (12 + 11 * nu) * shear * area);
  const double e2 = tip_deflection(2, thick, length, young) / expected - 1;
  const double e4 = tip_deflection(4, thick, length, young) / expected - 1;
  INFO("errors " << e2 << ' ' << e4);
  CHECK(e2 < 0);  // too stiff
  CHECK(std::abs(e4) < 0.12);
  // Second order, disturbed by the clamped end and by terms of fourth order.
  CHECK(e2 / e4 > 2.5);
  CHECK(e2 / e4 < 4.5);
}

TEST_CASE("Motions that anchors leave free are counted") {
  const MassSpringModel box = test::box_lattice(6, 4, 5);
  struct Case {
    Nodes anchored;
    std::uint32_t free;
  };
  // Node 1 is the neighbour of node 0 along x, node 6 along y.
  for (const auto& [anchored, free] : {Case{{0}, 3}, Case{{0, 1}, 1}, Case{{0, 5, 3}, 1},
                                       Case{{0, 1, 6}, 0}, Case{{6, 0, 1, 0, 1}, 0}}) {
    const ComponentModes component = zero_modes(box, anchored).at(0);
    CHECK(component.zero_modes == free);
    CHECK(component.expected == 0);
    CHECK(component.mechanism_nodes.empty() == (free == 0));
    CHECK(elastic_body(box, {.anchored = anchored}).zero_mode_count() == free);
  }
  CHECK(zero_modes(box, {0, 1, 6, 1}).at(0).anchored == 3);
}

TEST_CASE("A body with all nodes anchored has no modes and no displacements") {
  const MassSpringModel box = test::box_lattice(2, 2, 2);
  const MassSpringModel two = test::side_by_side(box, box, {9, 0, 0});
  const ElasticBody body = elastic_body(two, {.anchored = Nodes{0, 1, 2, 3, 4, 5, 6, 7}});
  CHECK(body.components.size() == 1);
  CHECK(lowest_modes(body, {.count = 100}).modes.size() == 18);
  CHECK(lowest_modes(body).zero_modes_skipped == 6);
  const ElasticBody none = elastic_body(box, {.anchored = Nodes{0, 1, 2, 3, 4, 5, 6, 7}});
  CHECK(lowest_modes(none).modes.empty());
  StaticLoad load = no_load(box);
  load.force[0].x() = 1;
  CHECK(solve_static(none, {load}).at(0).compliance == 0);
}

TEST_CASE("A load on a motion that the anchors leave free is rejected, other loads are not") {
  const MassSpringModel box = test::box_lattice(4, 4, 4);
  const ElasticBody hinged =
      elastic_body(box, {.anchored = Nodes{0, 3}});  // free to rotate about x
  StaticLoad load = no_load(box);
  load.force[63] = {0, 1, 0};
  CHECK_THROWS_WITH(solve_static(hinged, {load}), Catch::Matchers::Contains("anchor more nodes"));
  load.force[63] = {1, 0, 0};  // no torque about x
  CHECK(solve_static(hinged, {load}).at(0).compliance > 0);

  const MassSpringModel row = test::chain_of_nodes(20, 10);
  const ElasticBody held = elastic_body(row, {.anchored = Nodes{0}});
  StaticLoad pull = no_load(row);
  pull.force.back() = {2, 0, 0};
  CHECK(solve_static(held, {pull}).at(0).displacement.back().x() ==
        Approx(2 * 19 / 10.0).epsilon(1e-10));
  pull.force.back() = {2, 1e-3, 0};
  CHECK_THROWS_AS(solve_static(held, {pull}), InputError);

  // A free component beside a held one.
  const MassSpringModel two = test::side_by_side(box, box, {9, 0, 0});
  const ElasticBody half = elastic_body(two, {.anchored = Nodes{0, 1, 4}});
  StaticLoad push = no_load(two);
  push.force[63] = {1, 0, 0};
  CHECK(solve_static(half, {push}).at(0).compliance > 0);
  push.force[64] = {1, 0, 0};
  CHECK_THROWS_AS(solve_static(half, {push}), InputError);
}

TEST_CASE("mapped_nodes maps anchors to the groups of a level") {
  const Groups groups{{2, 0, 0, 1, 2}, 3};
  CHECK(mapped_nodes(groups, {}).empty());
  CHECK(mapped_nodes(groups, {4, 1, 2}) == Nodes{0, 2});
  CHECK_THROWS_AS(mapped_nodes(groups, {5}), InputError);
}

TEST_CASE("The springs of a support pull at the groups of their nodes") {
  const Groups groups{{2, 0, 0, 1, 2}, 3};
  const Support coarse = mapped_support(groups, {Nodes{3}, {{0, 5}, {1, 7}, {2, 8}}});
  CHECK(coarse.nodes == Nodes{1});
  REQUIRE(coarse.springs.size() == 3);
  CHECK(coarse.springs[0].node == 2);
  CHECK(coarse.springs[2].node == 0);
  CHECK(coarse.springs[2].stiffness == 8);
  CHECK_THROWS_AS(mapped_support(groups, {{}, {{5, 1}}}), InputError);
}

TEST_CASE("An anchored node that does not exist is rejected with its number") {
  const MassSpringModel box = test::box_lattice(2, 2, 2);
  CHECK_THROWS_WITH(elastic_body(box, {.anchored = Nodes{8}}),
                    Catch::Matchers::Contains("no node 9"));
  CHECK_THROWS_AS(zero_modes(box, {8}), InputError);
}

}  // namespace
}  // namespace springlod::elastic
