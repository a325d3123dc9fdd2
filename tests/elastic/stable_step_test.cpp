#include "elastic/stable_step.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "elastic/stiffness.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/lattices.hpp"

namespace springlod::elastic {
namespace {

using test::box_lattice;
using test::chain_of_nodes;
using test::make_model;

double dense_frequency(const MassSpringModel& m) {
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(3 * m.node_count(), 3 * m.node_count());
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const Vec3 u = spring_direction(m, s);
    Eigen::VectorXd row = Eigen::VectorXd::Zero(k.rows());
    row.segment<3>(3 * m.a[s]) = -u / std::sqrt(m.mass[m.a[s]]);
    row.segment<3>(3 * m.b[s]) = u / std::sqrt(m.mass[m.b[s]]);
    k += m.stiffness[s] * row * row.transpose();
  }
  return std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().maxCoeff());
}

TEST_CASE("Two masses on a spring have the frequency of the reduced mass") {
  MassSpringModel m = chain_of_nodes(2, 30);
  m.mass = {2, 3};
  const double exact = std::sqrt(30 * (1.0 / 2 + 1.0 / 3));
  CHECK(largest_frequency(m) == Approx(exact).epsilon(1e-12));
  CHECK(frequency_bound(m) == Approx(std::sqrt(30.0)).epsilon(1e-12));
}

TEST_CASE("The largest frequency of a long chain is at most 1e-4 above the analytical one") {
  const std::uint32_t n = GENERATE(20U, 60U, 400U);
  const double exact = 2 * std::sqrt(50.0) * std::sin(M_PI * (n - 1) / (2.0 * n));
  const double found = largest_frequency(chain_of_nodes(n, 50));
  CHECK(found >= exact * (1 - 1e-12));
  CHECK(found <= exact * (1 + 1e-4));
}

TEST_CASE("Lanczos agrees with a dense eigenvalue solver on an uneven lattice") {
  MassSpringModel m = box_lattice(4, 5, 6);
  for (std::uint32_t i = 0; i < m.node_count(); ++i) m.mass[i] = 1 + 0.3 * std::sin(i);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) m.stiffness[s] = 2 + std::cos(3.0 * s);
  const double exact = dense_frequency(m);
  const std::uint64_t seed = GENERATE(1U, 2U, 3U);
  const double found = largest_frequency(m, seed);
  CHECK(found >= exact * (1 - 1e-12));
  CHECK(found <= exact * (1 + 1e-4));
  CHECK(frequency_bound(m) >= found);
  CHECK(largest_frequency(m, seed) == found);
}

TEST_CASE("Held nodes are left out of the largest frequency") {
  // N - 2 masses between walls.
  const std::uint32_t n = GENERATE(20U, 400U);
  const MassSpringModel chain = chain_of_nodes(n, 50);
  const double free_ends = largest_frequency(chain);
  const double exact = 2 * std::sqrt(50.0) * std::sin(M_PI * (n - 2) / (2.0 * (n - 1)));
  const std::vector<std::uint32_t> ends{0, n - 1};
  const double found = largest_frequency(chain, 1, ends);
  CHECK(found >= exact * (1 - 1e-12));
  CHECK(found <= exact * (1 + 1e-4));
  CHECK(found <= free_ends);
  // One mass on two springs, and then none.
  std::vector<std::uint32_t> held;
  for (std::uint32_t i = 0; i < n; ++i)
    if (i != 7) held.push_back(i);
  CHECK(largest_frequency(chain, 1, held) == Approx(std::sqrt(100.0)).epsilon(1e-4));
  held.push_back(7);
  CHECK(largest_frequency(chain, 1, held) == 0);
}

TEST_CASE("frequency_bound is nearly attained in a lattice") {
  // Infinite lattice: omega^2 = 12 k/m (6 k in each direction at a node, twice).
  const MassSpringModel m = box_lattice(10, 10, 10);
  CHECK(frequency_bound(m) == Approx(std::sqrt(12.0)).epsilon(1e-12));
  CHECK(largest_frequency(m) > 0.95 * frequency_bound(m));
}

TEST_CASE("Dilatation terms raise the largest frequency, and its bounds stay above it") {
  const MassSpringModel m =
      GENERATE(test::lattice_with_terms(5, 5, 5), test::random_model_with_terms(6, 4, false));
  const Eigen::MatrixXd k(stiffness_matrix(m));
  Eigen::VectorXd root(k.rows());
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    root.segment<3>(3 * i).setConstant(1 / std::sqrt(m.mass[i]));
  const Eigen::MatrixXd scaled = root.asDiagonal() * k * root.asDiagonal();
  const double exact =
      std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly)
                    .eigenvalues()
                    .maxCoeff());
  CHECK(largest_frequency(m) == Approx(exact).epsilon(1.1e-4));
  CHECK(largest_frequency(m) >= exact * (1 - 1e-12));
  CHECK(frequency_bound(m) >= exact);
  CHECK(frequency_bound(m) < 1.6 * exact);
  MassSpringModel springs = m;
  springs.dilatation = {};
  CHECK(largest_frequency(springs) < exact);
  const std::vector<double> bounds = node_frequency_bounds(m, m.rest);
  CHECK(*std::max_element(bounds.begin(), bounds.end()) >= exact * exact);
  MassSpringModel damped = m;
  damped.dilatation.damping_time[1] = 0.3;
  CHECK(largest_damping_time(damped) == 0.3);
}

TEST_CASE("The bounds of a strained body with terms are above its largest frequency") {
  const MassSpringModel m =
      GENERATE(test::lattice_with_terms(3, 3, 3), test::random_model_with_terms(7, 3, true));
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    std::vector<Vec3> x = m.rest;
    const std::vector<Vec3> moves = test::random_vectors(seed, x.size(), 0.25);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += moves[i];
    // The second derivative of the energy of the terms, by finite differences; springs cannot have
    // more than their bound.
    MassSpringModel terms = m;
    for (double& stiffness : terms.stiffness) stiffness = 1e-9;
    const auto energy = [&](const Eigen::VectorXd& direction, double h) {
      std::vector<Vec3> at = x;
      for (std::size_t i = 0; i < at.size(); ++i)
        at[i] += h * direction.segment<3>(3 * static_cast<Eigen::Index>(i));
      return dilatation_energy(m.dilatation, at);
    };
    const std::vector<double> bounds = node_frequency_bounds(terms, x);
    const std::vector<Vec3> random = test::random_vectors(seed + 100, x.size(), 1);
    Eigen::VectorXd direction(3 * m.node_count());
    double kinetic = 0;
    for (std::uint32_t i = 0; i < m.node_count(); ++i) {
      direction.segment<3>(3 * i) = random[i];
      kinetic += bounds[i] * m.mass[i] * random[i].squaredNorm();
    }
    constexpr double h = 1e-4;
    const double curvature =
        (energy(direction, h) + energy(direction, -h) - 2 * energy(direction, 0)) / (h * h);
    CHECK(curvature <= kinetic * (1 + 1e-3));
    const std::vector<double> strained = strained_frequency_bounds(terms, x, 1e-3);
    for (std::uint32_t i = 0; i < m.node_count(); ++i)
      if (strained[i] > 0) CHECK(strained[i] == Approx(bounds[i]));
  }
}

TEST_CASE("The largest frequency is that of the stiffest connected component") {
  std::vector<Vec3> points;
  std::vector<test::Pair> pairs;
  for (std::uint32_t i = 0; i < 60; ++i) {
    points.emplace_back(2.0 * i, 0, 0);
    points.emplace_back(2.0 * i + 1, 0, 0);
    pairs.emplace_back(2 * i, 2 * i + 1);
  }
  MassSpringModel m = make_model(points, pairs);
  m.stiffness[17] = 8;
  CHECK(largest_frequency(m) == Approx(4).epsilon(1e-4));
}

TEST_CASE("The stable time step follows the formula for damped springs") {
  CHECK(stable_step(10, 0) == Approx(0.2).epsilon(1e-14));
  CHECK(stable_step(10, 0.3) == Approx(-0.3 + std::sqrt(0.09 + 0.04)).epsilon(1e-14));
  CHECK(stable_step(1e-3, 1e6) == Approx(2).epsilon(1e-6));
  CHECK(std::isinf(stable_step(0, 0.3)));

  MassSpringModel m = chain_of_nodes(3, 4);
  m.damping = {4 * 0.1, 4 * 0.2};
  CHECK(largest_damping_time(m) == Approx(0.2).epsilon(1e-14));
  CHECK(stable_step(m) == Approx(stable_step(largest_frequency(m), 0.2)).epsilon(1e-14));
  m.a.clear();
  m.b.clear();
  m.rest_length.clear();
  m.stiffness.clear();
  m.damping.clear();
  CHECK(std::isinf(stable_step(m)));
}

}  // namespace
}  // namespace springlod::elastic
