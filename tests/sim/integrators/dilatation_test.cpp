#include "sim/integrators/dilatation.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "sim/integrators/kernel.hpp"
#include "sim/run.hpp"
#include "tests/support/dilatation.hpp"
#include "tests/support/soft_blocks.hpp"

using namespace springlod;
using namespace springlod::sim;
using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

std::vector<Vec3> moved(std::vector<Vec3> x, const std::vector<Vec3>& by, double factor) {
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += factor * by[i];
  return x;
}

double dot(const std::vector<Vec3>& p, const std::vector<Vec3>& q) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p[i].dot(q[i]);
  return sum;
}

std::vector<Vec3> scaled(std::vector<Vec3> x, const Vec3& factors) {
  for (Vec3& each : x) each = each.cwiseProduct(factors);
  return x;
}

/// The stretch of both sides with which a block of the given stretch of its height has the least
/// energy: its faces are free to glide.
double free_side(const MassSpringModel& model, double height) {
  const auto energy = [&](double side) {
    return elastic_energy(model, scaled(model.rest, Vec3(side, side, height)));
  };
  double low = 0.9, high = 1.3;
  while (high - low > 1e-9) {
    const double third = (high - low) / 3;
    if (energy(low + third) < energy(high - third))
      high -= third;
    else
      low += third;
  }
  return (low + high) / 2;
}

}  // namespace

TEST_CASE("The forces of terms are the negative gradient of their energy, without resultant") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const MassSpringModel model = random_model_with_terms(seed);
    const std::size_t n = model.rest.size();
    const std::vector<Vec3> x = moved(model.rest, random_vectors(seed, n, 1), 0.3);
    const std::vector<Vec3> u = random_vectors(seed + 10, n, 1);
    std::vector<Vec3> force(n, Vec3::Zero()), damping(n, Vec3::Zero());
    const std::vector<Vec3> still(n, Vec3::Zero());
    add_dilatation_forces<false>(model.dilatation, x, still, force, damping);
    constexpr double h = 1e-6;
    const double slope = (dilatation_energy(model.dilatation, moved(x, u, h)) -
                          dilatation_energy(model.dilatation, moved(x, u, -h))) /
                         (2 * h);
    CHECK(dot(force, u) == Approx(-slope).epsilon(1e-6));
    Vec3 sum = Vec3::Zero(), torque = Vec3::Zero();
    double size = 0;
    for (std::size_t i = 0; i < n; ++i) {
      sum += force[i];
      torque += x[i].cross(force[i]);
      size += force[i].norm();
    }
    CHECK(sum.norm() < 1e-12 * size);
    CHECK(torque.norm() < 1e-11 * size);
  }
}

TEST_CASE("The damping of terms is beta times the rate of their forces about rest") {
  MassSpringModel model = random_model_with_terms(2);
  for (double& time : model.dilatation.damping_time) time = 0.003;
  const std::size_t n = model.rest.size();
  const std::vector<Vec3> v = random_vectors(20, n, 1);
  std::vector<Vec3> both(n, Vec3::Zero()), damping(n, Vec3::Zero());
  add_dilatation_forces<true>(model.dilatation, model.rest, v, both, damping);
  std::vector<Vec3> ahead(n, Vec3::Zero()), none(n, Vec3::Zero());
  constexpr double h = 1e-6;
  add_dilatation_forces<false>(model.dilatation, moved(model.rest, v, h), none, ahead, none);
  for (std::size_t i = 0; i < n; ++i) {
    CHECK((both[i] - damping[i]).norm() < 1e-9);  // no strain at rest
    CHECK((damping[i] - 0.003 / h * ahead[i]).norm() < 1e-3 * (damping[i].norm() + 1e-3));
  }
}

TEST_CASE("A spinning, vibrating body with terms keeps its energy and momentum") {
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet,
                                   Integrator::runge_kutta_4);
  const double nu = GENERATE(0., 0.45);
  const MassSpringModel model =
      block(3, 4, 3, 0.1, soft_material(nu, 0), voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.start.spin = {1, 4, -2};
  scene.duration = 0.1;
  State start = initial_state(model, scene.start);
  for (std::size_t i = 0; i < start.x.size(); ++i)
    start.v[i] += Vec3(std::sin(40 * start.x[i].y()), std::cos(30 * start.x[i].z()), 0);
  const Trajectory run = sim::run(model, scene, start, {.integrator = integrator, .safety = 0.3});
  CHECK(closure_error(run.ledger) < 0.01);
  const auto spin_of = [&](const State& state) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < state.x.size(); ++i)
      sum += model.mass[i] * state.x[i].cross(state.v[i]);
    return sum;
  };
  CHECK((spin_of(run.final) - spin_of(start)).norm() < 1e-3 * spin_of(start).norm());
}

TEST_CASE("Implicit integrators refuse terms, and say what to use") {
  const MassSpringModel model = soft_block(2, 2, 2, 0.4);
  for (const Integrator integrator :
       {Integrator::backward_euler_cg, Integrator::xpbd, Integrator::projective_dynamics}) {
    CHECK_THROWS_AS(run(model, Scenario{}, {.integrator = integrator}), InputError);
    CHECK_THROWS_WITH(run(model, Scenario{}, {.integrator = integrator}),
                      Contains("springs only") && Contains("symplectic_euler"));
  }
}

TEST_CASE("A squeezed block of soft rubber keeps its volume, one of nu = 1/4 does not") {
  constexpr double kHeight = 0.8;
  const auto change = [&](double nu) {
    const MassSpringModel model = soft_block(3, 3, 3, nu);
    const double side = free_side(model, kHeight);
    return side * side * kHeight - 1;
  };
  CHECK(std::abs(change(0.495)) < 0.01);
  CHECK(std::abs(change(0.49)) < 0.02);
  // Its sides stretch by a fourth of what its height loses, as they do when it loses little.
  const double side = 1 + 0.25 * (1 - kHeight);
  CHECK(change(0.25) == Approx(side * side * kHeight - 1).epsilon(0.02));
}

TEST_CASE("A slightly squeezed block widens by its Poisson's ratio") {
  constexpr double kHeight = 0.9998;
  for (const double nu : {-0.2, 0., 0.25, 0.45, 0.495})
    CHECK((free_side(soft_block(3, 3, 3, nu), kHeight) - 1) / (1 - kHeight) ==
          Approx(nu).margin(1e-3));
}
