#include "elastic/modes.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/elastic/elastic_samples.hpp"
#include "tests/support/models.hpp"

namespace springlod::elastic {
namespace {

/// Random stiffnesses over four powers of ten.
MassSpringModel uneven_model(std::uint64_t seed, int n) {
  MassSpringModel m = test::random_model(seed, n);
  std::mt19937_64 random(seed + 100);
  for (double& k : m.stiffness) k *= std::pow(10.0, 4 * test::uniform(random));
  return m;
}

void check_against_dense(const MassSpringModel& m, const Modes& found, double tolerance) {
  const auto dense = test::dense_spectrum(m);
  for (std::size_t i = 0; i < found.modes.size(); ++i) {
    const double squared =
        dense.eigenvalues()[static_cast<Eigen::Index>(i + found.zero_modes_skipped)];
    INFO("mode " << i);
    CHECK(found.modes[i].angular_frequency == Approx(std::sqrt(squared)).epsilon(tolerance));
  }
}

TEST_CASE("The lowest modes of uneven models are those of a dense solver") {
  // Below and above the size at which the iteration replaces the dense solver.
  const int n = GENERATE(4, 5, 7);
  const std::uint64_t seed = GENERATE(1U, 2U);
  const MassSpringModel m = uneven_model(seed, n);
  const Modes found = lowest_modes(m);
  REQUIRE(found.modes.size() == 20);
  CHECK(found.zero_modes_skipped == 6);
  check_against_dense(m, found, 1e-6);
  for (const Mode& mode : found.modes) CHECK(mode.residual <= 1e-4);
}

TEST_CASE("Shapes to start from, good or bad, do not change the modes", "[long]") {
  const MassSpringModel m = uneven_model(3, 7);
  std::vector<std::vector<Vec3>> start;
  const auto add = [&](const MassSpringModel& of, std::size_t first, std::size_t count) {
    const Modes modes = lowest_modes(of);
    for (std::size_t i = first; i < first + count; ++i) start.push_back(modes.modes[i].shape);
  };
  SECTION("those of a similar model") {
    add(uneven_model(4, 7), 0, 20);
  }
  SECTION("its own") {
    add(m, 0, 20);
  }
  SECTION("its own without the lowest") {
    add(m, 3, 17);
  }
  SECTION("the same one three times") {
    for (int i = 0; i < 3; ++i) add(m, 5, 1);
  }
  SECTION("rest") {
    start.assign(2, std::vector<Vec3>(m.node_count(), Vec3::Zero()));
  }
  check_against_dense(m, lowest_modes(m, {.start = start}), 1e-6);
}

TEST_CASE("The iteration reaches a higher requested accuracy") {
  const MassSpringModel m = uneven_model(3, 6);
  const Modes found = lowest_modes(m, {.count = 40, .accuracy = 1e-8});
  check_against_dense(m, found, 1e-10);
  for (const Mode& mode : found.modes) CHECK(mode.residual <= 1e-8);
}

TEST_CASE("Shapes are mass-normalised, orthogonal and solve K x = omega^2 M x") {
  const MassSpringModel m = uneven_model(4, 6);
  const double accuracy = 1e-7;
  const Modes found = lowest_modes(m, {.count = 12, .accuracy = accuracy});
  const auto k = stiffness_matrix(m);
  Eigen::VectorXd mass(k.rows());
  for (Eigen::Index i = 0; i < mass.size(); ++i) mass[i] = m.mass[static_cast<std::size_t>(i / 3)];
  for (const Mode& mode : found.modes) {
    const Eigen::VectorXd x = test::flatten(mode.shape);
    const Eigen::VectorXd inertia =
        mode.angular_frequency * mode.angular_frequency * mass.cwiseProduct(x);
    CHECK((k * x - inertia).norm() < 100 * accuracy * inertia.norm());
    for (const Mode& other : found.modes) {
      const double product = x.dot(mass.cwiseProduct(test::flatten(other.shape)));
      CHECK(product == Approx(&mode == &other ? 1 : 0).margin(10 * accuracy));
    }
  }
}

TEST_CASE("A chain has longitudinal modes of a row of masses, its lateral motions are mechanisms") {
  const std::uint32_t n = GENERATE(6U, 150U);
  const double k = 40;
  const Modes found = lowest_modes(test::chain_of_nodes(n, k), {.count = 5});
  CHECK(found.zero_modes_skipped == 2 * n + 1);
  REQUIRE(found.modes.size() == 5);
  for (std::uint32_t j = 1; j <= 5; ++j)
    CHECK(found.modes[j - 1].angular_frequency ==
          Approx(2 * std::sqrt(k) * std::sin(j * std::numbers::pi / (2 * n))).epsilon(1e-7));
}

TEST_CASE("Zero modes of all components and mechanisms are counted") {
  const MassSpringModel box = test::box_lattice(5, 4, 6);
  SECTION("of two bodies") {
    CHECK(lowest_modes(test::side_by_side(box, box, {9, 0, 0})).zero_modes_skipped == 12);
  }
  SECTION("of a body beside a single node") {
    const MassSpringModel dot = test::make_model({{0, 0, 0}}, {});
    CHECK(lowest_modes(test::side_by_side(box, dot, {9, 0, 0})).zero_modes_skipped == 9);
    CHECK(lowest_modes(dot).modes.empty());
  }
  SECTION("of a body with a node on a single spring") {
    MassSpringModel m = test::side_by_side(box, test::make_model({{0, 0, 0}}, {}), {5, 1, 2});
    m.a.push_back(119);
    m.b.push_back(120);
    m.stiffness.push_back(1);
    m.rest_length.push_back((m.rest[120] - m.rest[119]).norm());
    m.damping.push_back(0);
    const Modes found = lowest_modes(m);
    CHECK(found.zero_modes_skipped == 8);
    check_against_dense(m, found, 1e-7);
  }
}

TEST_CASE("Twelve equal bodies have each mode twelve times") {
  const MassSpringModel box = test::box_lattice(4, 5, 6);
  MassSpringModel row = box;
  for (int i = 1; i < 12; ++i) row = test::side_by_side(row, box, {9.0 * i, 0, 0});
  const Modes one = lowest_modes(box, {.count = 3});
  const Modes all = lowest_modes(row, {.count = 36});
  REQUIRE(all.modes.size() == 36);
  CHECK(all.zero_modes_skipped == 72);
  for (std::size_t i = 0; i < 36; ++i)
    CHECK(all.modes[i].angular_frequency ==
          Approx(one.modes[i / 12].angular_frequency).epsilon(1e-7));
}

TEST_CASE("Each threefold mode of a cube is found three times") {
  const MassSpringModel cube = test::box_lattice(7, 7, 7);
  check_against_dense(cube, lowest_modes(cube, {.count = 30}), 1e-7);
}

/// First bending frequency [Hz] of a free bar of square section by ASTM E1876, eqs. 1 and 2:
/// Euler-Bernoulli with Pickett's correction (1945) for shear and rotary inertia.
double first_bend(double thick, double length, double young, double nu, double density) {
  const double t = thick / length;
  const double correction = 1 + 6.585 * (1 + 0.0752 * nu + 0.8109 * nu * nu) * t * t -
                            0.868 * std::pow(t, 4) -
                            8.340 * (1 + 0.2023 * nu + 2.173 * nu * nu) * std::pow(t, 4) /
                                (1 + 6.338 * (1 + 0.1408 * nu + 1.536 * nu * nu) * t * t);
  const double mass = density * thick * thick * length;
  return std::sqrt(young * thick * std::pow(thick / length, 3) / (0.9465 * mass * correction));
}

TEST_CASE("The bending frequency of a free bar converges to Timoshenko's with finer cells") {
  const double young = 2e6, density = 1000, thick = 0.1, length = 0.8;
  const double expected = first_bend(thick, length, young, 0.25, density);
  std::vector<double> found;
  for (const int cells : {2, 4, 8}) {
    const MassSpringModel bar =
        test::corners_box(cells, cells, 8 * cells, thick / cells, young, density);
    const Modes modes = lowest_modes(bar, {.count = 2});
    CHECK(modes.zero_modes_skipped == 6);
    // Both bending directions have the same frequency.
    CHECK(modes.modes[0].frequency() == Approx(modes.modes[1].frequency()).epsilon(1e-6));
    found.push_back(modes.modes[0].frequency());
  }
  INFO("expected " << expected << " found " << found[0] << ' ' << found[1] << ' ' << found[2]);
  // Errors are of second order in the cell, so each halving removes three quarters. With two cells
  // in cross-section, terms of fourth order are still visible.
  CHECK((found[1] - found[0]) / (found[2] - found[1]) == Approx(4).epsilon(0.2));
  // The limit by Richardson extrapolation. At a thickness of an eighth of the length the formula
  // has an error of some 0.1 %.
  CHECK(found[2] + (found[2] - found[1]) / 3 == Approx(expected).epsilon(1e-3));
  CHECK(found[2] == Approx(expected).epsilon(0.01));
}

TEST_CASE("The same seed gives the same bits, another seed the same modes") {
  const MassSpringModel m = uneven_model(5, 6);
  const Modes first = lowest_modes(m), second = lowest_modes(m),
              other = lowest_modes(m, {.seed = 9});
  REQUIRE(first.modes.size() == second.modes.size());
  for (std::size_t i = 0; i < first.modes.size(); ++i) {
    CHECK(first.modes[i].angular_frequency == second.modes[i].angular_frequency);
    CHECK(first.modes[i].residual == second.modes[i].residual);
    CHECK(first.modes[i].shape == second.modes[i].shape);
    CHECK(other.modes[i].angular_frequency ==
          Approx(first.modes[i].angular_frequency).epsilon(1e-6));
  }
}

TEST_CASE("A model with fewer modes than requested returns all of its modes") {
  CHECK(lowest_modes(test::chain_of_nodes(4), {.count = 50}).modes.size() == 3);
  const MassSpringModel m = uneven_model(6, 5);
  const Modes all = lowest_modes(m, {.count = 1000});
  CHECK(all.modes.size() == 3 * 125 - 6);
  check_against_dense(m, all, 1e-7);
}

TEST_CASE("Extremely uneven springs give finite frequencies") {
  MassSpringModel m = test::box_lattice(6, 5, 5);
  std::mt19937_64 random(8);
  for (double& k : m.stiffness) k = std::pow(10.0, 14 * test::uniform(random));
  for (const Mode& mode : lowest_modes(m).modes) {
    CHECK(std::isfinite(mode.angular_frequency));
    CHECK(mode.angular_frequency >= 0);
  }
}

TEST_CASE("Invalid options are rejected") {
  const MassSpringModel m = test::box_lattice(2, 2, 2);
  CHECK_THROWS_AS(lowest_modes(m, {.count = 0}), InputError);
  CHECK_THROWS_AS(lowest_modes(m, {.accuracy = 0}), InputError);
  CHECK_THROWS_AS(lowest_modes(m, {.accuracy = NAN}), InputError);
}

TEST_CASE("A model that is not finite is rejected with the number of the node or spring") {
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  for (const int n : {4, 12}) {  // by the dense solver, and by the iteration
    const MassSpringModel sound = test::box_lattice(n, n, n);
    for (const double wrong : {nan, infinite}) {
      MassSpringModel m = sound;
      m.stiffness[5] = wrong;
      CHECK_THROWS_WITH(lowest_modes(m), Catch::Contains("the spring of the nodes"));
      m = sound;
      m.mass[3] = wrong;
      CHECK_THROWS_WITH(lowest_modes(m), Catch::Contains("node 4 "));
      m = sound;
      m.rest[2].y() = wrong;
      CHECK_THROWS_WITH(lowest_modes(m), Catch::Contains("node 3 "));
    }
    ElasticBody body = elastic_body(sound);
    body.components.front().stiffness.coeffRef(0, 0) = nan;
    CHECK_THROWS_WITH(lowest_modes(body), Catch::Contains("is not finite"));
    MassSpringModel light = sound;
    light.mass[0] = 0;
    CHECK_THROWS_AS(lowest_modes(light), InputError);
    light.mass[0] = 1e-308;
    light.stiffness.assign(light.spring_count(), 1e300);
    CHECK_THROWS_AS(lowest_modes(light), InputError);
  }
}

TEST_CASE("lowest_modes can be interrupted") {
  struct Interrupt : Progress {
    void advance(std::uint64_t) override { throw InterruptedError(); }
  } interrupt;
  CHECK_THROWS_AS(lowest_modes(uneven_model(7, 5), {.progress = &interrupt}), InterruptedError);
}

}  // namespace
}  // namespace springlod::elastic
