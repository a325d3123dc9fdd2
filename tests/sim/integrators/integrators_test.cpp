// Schemes other than leapfrog: their order, their conserved quantities, and the agreement of
// schemes that solve the same equations.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "sim/integrators/runge_kutta.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

const double kOmega = 20;  // of two masses of 2 kg (reduced mass 1 kg) on 400 N/m [rad/s]
const double kPeriod = 2 * std::numbers::pi / kOmega;

/// Two nodes of 2 kg on a spring of 400 N/m and damping time `beta`, stretched by 1 cm.
MassSpringModel stretched_pair(double beta) {
  MassSpringModel m = test::table_model({{0, 0, 0}, {1, 0, 0}}, {2, 2}, {{0, 1, 400}});
  m.damping[0] = beta * 400;
  m.rest[1].x() += 0.01;
  return m;
}

double stretch_after(const RunOptions& options, double beta, double duration) {
  const Trajectory t = run(stretched_pair(beta), test::weightless(duration), options);
  return (t.final.x[1] - t.final.x[0]).norm() - 1;
}

double exact_stretch(double beta, double time) {
  const double decay = beta * kOmega * kOmega / 2;
  const double omega = std::sqrt(kOmega * kOmega - decay * decay);
  return 0.01 * std::exp(-decay * time) *
         (std::cos(omega * time) + decay / omega * std::sin(omega * time));
}

double largest_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

/// Order of the error in the step length.
int order_of(Integrator integrator, bool damped) {
  switch (integrator) {
    case Integrator::runge_kutta_4:
      return 4;
    case Integrator::velocity_verlet:
      return 2;
    case Integrator::symplectic_euler:
      return damped ? 1 : 2;
    default:
      return 1;
  }
}

RunOptions with(Integrator integrator, double step, std::uint32_t iterations = 0) {
  return {.integrator = integrator, .solver = {.iterations = iterations}, .step = step};
}

}  // namespace

TEST_CASE("Every scheme follows a damped vibration at its order") {
  const double duration = 1.3 * kPeriod;
  const double beta = GENERATE(0.0, 0.01);
  const double exact = exact_stretch(beta, duration);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator), beta);
    const std::uint32_t enough = 100;  // iterations; converged, so that only the step size matters
    const auto error = [&](int steps) {
      return stretch_after(with(integrator, duration / steps, enough), beta, duration) - exact;
    };
    const int order = order_of(integrator, beta > 0);
    const int steps = order == 4 ? 100 : 2000;  // of order 4, rounding would decide with more
    CHECK(std::abs(error(steps)) < (order == 4 ? 5.5e-8 : 4e-4));
    CHECK(error(steps / 2) / error(steps) == Approx(std::exp2(order)).epsilon(0.1));
  }
}

TEST_CASE("Every scheme keeps momentum and, thrown free, the parabola within its order", "[long]") {
  const MassSpringModel model = test::rods();
  Scenario scene;
  scene.duration = 0.2;
  scene.start.velocity = {3, 1, 4};
  scene.start.spin = {4, 2, 1};
  const Vec3 start = center_of_mass(model, model.rest);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options;
    options.integrator = integrator;
    options.solver.tolerance = 1e-10;
    options.frame_rate = 0;
    const Trajectory t = run(model, scene, options);
    const Vec3 speed = scene.start.velocity + t.simulated * scene.gravity;
    Vec3 momentum = Vec3::Zero();
    for (std::uint32_t i = 0; i < model.node_count(); ++i) momentum += model.mass[i] * t.final.v[i];
    CHECK((momentum / mass_properties(model).mass - speed).norm() < 1e-6);  // what solvers leave
    const Vec3 fall = 0.5 * t.simulated * t.simulated * scene.gravity;
    const Vec3 way = center_of_mass(model, t.final.x) - start;
    // In free fall, the first-order schemes use the velocity at the end of the step.
    const double late = is_implicit(integrator) ? 0.5 * 9.81 * t.simulated * t.step : 0;
    CHECK((way - scene.start.velocity * t.simulated - fall).norm() == Approx(late).margin(1e-7));
  }
}

TEST_CASE("Backward Euler gives the same by conjugate gradients and by factorization") {
  const MassSpringModel model = test::rods();
  Scenario scene;
  scene.duration = 0.05;
  scene.start.spin = {4, 2, 1};
  scene.obstacles = {test::floor(1e6, 0.5)};
  RunOptions options = with(Integrator::backward_euler_direct, 0.002);
  options.solver.tolerance = 1e-10;
  const Trajectory direct = run(model, scene, options);
  options.integrator = Integrator::backward_euler_cg;
  const Trajectory iterative = run(model, scene, options);
  CHECK(largest_distance(direct.final.x, iterative.final.x) < 1e-8);
}

TEST_CASE("Swept to convergence, XPBD and projective dynamics are backward Euler") {
  MassSpringModel model = test::random_model(3, 3);
  for (double& k : model.stiffness)
    k *= 1e4;  // k dt^2 / m of about 25, so that several iterations are needed
  Scenario scene = test::weightless(0.05);
  scene.start.spin = {3, 1, 2};
  RunOptions options = with(Integrator::backward_euler_direct, 0.005);
  options.solver.tolerance = 1e-12;
  const State end = run(model, scene, options).final;
  const double moved = largest_distance(end.x, model.rest);
  for (const Integrator integrator : {Integrator::xpbd, Integrator::projective_dynamics}) {
    CAPTURE(to_string(integrator));
    const auto off = [&](std::uint32_t iterations) {
      return largest_distance(run(model, scene, with(integrator, 0.005, iterations)).final.x,
                              end.x);
    };
    // XPBD corrects along the spring directions of each sweep instead of those at the end of the
    // step. Its limit is therefore close to backward Euler, but not equal to it.
    const double limit = integrator == Integrator::xpbd ? 1e-2 : 1e-5;
    CHECK(off(1000) < limit * moved);
    CHECK(off(2) > 10 * off(1000));
  }
}

TEST_CASE("Implicit schemes stay bounded at any step, and lose energy") {
  const MassSpringModel model = test::rods();
  Scenario scene = test::weightless(1);
  scene.start.spin = {4, 2, 1};
  const double explicit_limit = predicted_step(model);
  for (const Integrator integrator :
       {Integrator::backward_euler_cg, Integrator::backward_euler_direct, Integrator::xpbd,
        Integrator::projective_dynamics}) {
    CAPTURE(to_string(integrator));
    CHECK(predicted_step(model, integrator) == std::numeric_limits<double>::infinity());
    const Trajectory t = run(model, scene, with(integrator, 50 * explicit_limit));
    const LedgerEntry& first = t.ledger.front();
    const LedgerEntry& last = t.ledger.back();
    CHECK(last.kinetic < first.kinetic);
    CHECK(last.kinetic > 0.1 * first.kinetic);
    // With such a long step, one sweep of XPBD leaves springs far from their target lengths.
    if (integrator != Integrator::xpbd) CHECK(last.kinetic + last.elastic < first.kinetic);
  }
}

TEST_CASE("Runge-Kutta is stable below its predicted step and diverges above it") {
  CHECK(runge_kutta_stable_step(10, 0) == Approx(2 * std::sqrt(2) / 10).epsilon(1e-6));
  CHECK(runge_kutta_stable_step(0, 0.1) == std::numeric_limits<double>::infinity());
  // Overdamped: the fast root is about -beta omega^2, and the stability interval on the real axis
  // ends at 2.7853.
  CHECK(runge_kutta_stable_step(100, 1) == Approx(2.7853 / 1e4).epsilon(1e-3));
  const double beta = GENERATE(0.0, 0.002);
  MassSpringModel model = test::random_model(1, 3);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    model.damping[s] = beta * model.stiffness[s];
  model.rest[0].x() += 1e-4;  // something to vibrate
  Scenario scene = test::weightless(1);
  const double limit = predicted_step(model, Integrator::runge_kutta_4);
  scene.duration = 10000 * limit;
  CHECK_NOTHROW(run(model, scene, with(Integrator::runge_kutta_4, 0.97 * limit)));
  CHECK_THROWS_AS(run(model, scene, with(Integrator::runge_kutta_4, 1.03 * limit)), UnstableError);
}

TEST_CASE("Runge-Kutta closes the ledger of the rods thrown at the wall", "[long]") {
  const auto model = test::rods();
  const Scenario scene = test::rods_scene();
  RunOptions options;
  options.integrator = Integrator::runge_kutta_4;
  options.safety = 0.25;
  CHECK(closure_error(run(model, scene, options).ledger) < 0.01);
}

TEST_CASE("A sliding block stops after 1.5 m under every scheme") {
  const auto model = test::block(6, 4, 2, 0.2, test::material("block", 1e7, 1000, 0.001),
                                 voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.gravity = {0, 0, -10};
  scene.obstacles = {test::floor(2e7, 0.3)};
  scene.obstacles[0].damping = 0.001;
  scene.start.placed = true;
  double lowest = model.rest[0].z();
  for (const Vec3& x : model.rest) lowest = std::min(lowest, x.z());
  scene.start.position = {0, 0, mass_properties(model).center.z() - lowest};
  scene.start.velocity = {3, 0, 0};
  scene.duration = 1.3;
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options;
    options.integrator = integrator;
    options.frame_rate = 0;
    const Trajectory t = run(model, scene, options);
    const double way =
        measured_distance(scene, scene.start.position, center_of_mass(model, t.final.x));
    CHECK(way == Approx(1.5).epsilon(0.01));
  }
}

TEST_CASE("The same run gives the same bits under every scheme") {
  const MassSpringModel model = test::rods();
  Scenario scene;
  scene.duration = 0.02;
  scene.start.spin = {4, 2, 1};
  for (const Integrator integrator : all_choices<Integrator>()) {
    RunOptions options;
    options.integrator = integrator;
    const State first = run(model, scene, options).final;
    const State second = run(model, scene, options).final;
    CHECK(largest_distance(first.x, second.x) == 0);
    CHECK(largest_distance(first.v, second.v) == 0);
  }
}
