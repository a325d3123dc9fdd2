// Motions with known solutions: free flight, conserved momenta, oscillators, bounces.
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "elastic/stable_step.hpp"
#include "sim/integrators/kernel.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

constexpr double kMass = 2;
constexpr double kStiffness = 800;
// Two equal masses on one spring: omega^2 = k / (m / 2).
const double kOmega = std::sqrt(2 * kStiffness / kMass);

/// Two nodes on a spring along x, each with a contact area of `area`.
MassSpringModel pair_of_nodes(double damping_time, double area = 0) {
  MassSpringModel m;
  m.rest = {Vec3(0, 0, 0), Vec3(1, 0, 0)};
  m.mass = {kMass, kMass};
  m.volume = {1, 1};
  m.contact_area = {area, area};
  m.border = {1, 1};
  m.material = {0, 0};
  m.a = {0};
  m.b = {1};
  m.rest_length = {1};
  m.stiffness = {kStiffness};
  m.damping = {damping_time * kStiffness};
  m.materials = {Material{.name = "m"}};
  return m;
}

/// Stretched by 1 % and released: each end moves with half of the amplitude.
MassSpringModel stretched(MassSpringModel m, double by) {
  m.rest[1].x() += by;
  return m;
}

double stretch_at(const Frame& frame) {
  return (frame.x[1] - frame.x[0]).norm() - 1;
}

Vec3 momentum(const MassSpringModel& m, const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < m.node_count(); ++i) sum += m.mass[i] * s.v[i];
  return sum;
}

Vec3 angular_momentum(const MassSpringModel& m, const State& s) {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t i = 0; i < m.node_count(); ++i) sum += m.mass[i] * s.x[i].cross(s.v[i]);
  return sum;
}

}  // namespace

TEST_CASE("In free flight the centre of mass lies on the parabola to rounding") {
  const auto model = test::rods();
  Scenario scene;
  scene.start.velocity = {3, 1, 4};
  scene.start.spin = {1, 5, 2};
  scene.duration = 1;
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  const auto t = run(model, scene, {.integrator = integrator, .frame_rate = 10});
  const Vec3 start = center_of_mass(model, model.rest);
  const Vec3 way = center_of_mass(model, t.final.x) - start;
  const double s = t.simulated;
  CHECK((way - (scene.start.velocity * s + 0.5 * s * s * scene.gravity)).norm() < 1e-9);
  const Vec3 speed = momentum(model, t.final) / mass_properties(model).mass;
  CHECK((speed - (scene.start.velocity + s * scene.gravity)).norm() < 1e-9);
  // Frames between steps lie on the chord: error at most g dt^2 / 8.
  REQUIRE(t.frames.size() == 11);
  for (const Frame& frame : t.frames) {
    const Vec3 exact =
        start + scene.start.velocity * frame.time + 0.5 * frame.time * frame.time * scene.gravity;
    CHECK((center_of_mass(model, frame.x) - exact).norm() < 9.81 * t.step * t.step / 8 + 1e-9);
  }
}

TEST_CASE("Momentum and angular momentum are kept to rounding without gravity and contact") {
  const auto model = test::rods();
  Scenario scene = test::weightless(1);
  scene.start.velocity = {3, 1, 4};
  scene.start.spin = {10, 50, 20};  // hard enough to bend the joint strongly
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  const State start = initial_state(model, scene.start);
  const auto t = run(model, scene, {.integrator = integrator});
  const Vec3 p = momentum(model, start);
  CHECK((momentum(model, t.final) - p).norm() < 1e-11 * p.norm());
  // The initial half step backwards applies forces too: it conserves L at x_0, so L = sum m x v+
  // afterwards. At whole steps, v = (v- + v+)/2 adds x_n x dt F_n / 2, which is 0 for forces along
  // springs.
  const Vec3 l = angular_momentum(model, start);
  CHECK((angular_momentum(model, t.final) - l).norm() < 1e-10 * l.norm());
}

TEST_CASE("Two nodes on a spring vibrate at the frequency of theory") {
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  const double period = 2 * std::numbers::pi / kOmega;
  const double step = period / 200;
  const auto model = stretched(pair_of_nodes(0), 0.01);
  const auto t = run(model, test::weightless(20 * period),
                     {.integrator = integrator, .step = step, .frame_rate = 1 / step});
  // The frequency of leapfrog is slightly too high: omega' = (2/dt) asin(omega dt / 2), exactly.
  const double omega = 2 / step * std::asin(kOmega * step / 2);
  double worst = 0;
  double from_theory = 0;
  for (const Frame& frame : t.frames) {
    worst = std::max(worst, std::abs(stretch_at(frame) - 0.01 * std::cos(omega * frame.time)));
    from_theory =
        std::max(from_theory, std::abs(stretch_at(frame) - 0.01 * std::cos(kOmega * frame.time)));
  }
  CHECK(worst < 1e-10);
  CHECK(from_theory < 0.01 * 0.01);  // 20 periods at (omega dt)^2 / 24: 0.5 % of a radian
}

TEST_CASE("A damped vibration decays at the rate of theory") {
  // stretch'' = -omega^2 (stretch + beta stretch'): decay beta omega^2 / 2.
  const double damping_time = 0.004;
  const double period = 2 * std::numbers::pi / kOmega;
  const double decay = damping_time * kOmega * kOmega / 2;
  const double damped_omega = std::sqrt(kOmega * kOmega - decay * decay);
  const auto model = stretched(pair_of_nodes(damping_time), 0.01);
  const auto deviation = [&](Integrator integrator, double step) {
    const auto t = run(model, test::weightless(5 * period),
                       {.integrator = integrator, .step = step, .frame_rate = 20 / period});
    double worst = 0;
    for (const Frame& frame : t.frames) {
      const double phase = damped_omega * frame.time;
      const double exact = 0.01 * std::exp(-decay * frame.time) *
                           (std::cos(phase) + decay / damped_omega * std::sin(phase));
      worst = std::max(worst, std::abs(stretch_at(frame) - exact));
    }
    return worst / 0.01;
  };
  const double step = period / 400;
  const double euler = deviation(Integrator::symplectic_euler, step);
  const double verlet = deviation(Integrator::velocity_verlet, step);
  // Damping forces that are half a step late increase the frequency by the fraction decay dt / 2.
  // The phase error omega t decay dt / 2 times exp(-decay t) is largest at t = 1 / decay.
  CHECK(euler == Approx(kOmega * step / (2 * std::numbers::e)).epsilon(0.1));
  CHECK(verlet < 0.0006);
  // First and second order in the step.
  CHECK(euler / deviation(Integrator::symplectic_euler, step / 2) == Approx(2).epsilon(0.3));
  CHECK(verlet / deviation(Integrator::velocity_verlet, step / 2) == Approx(4).epsilon(0.2));
}

TEST_CASE("A spring that shrinks to a point stays finite") {
  MassSpringModel model = pair_of_nodes(0.001);
  const std::vector<Vec3> x{Vec3(1, 1, 1), Vec3(1, 1, 1)};
  const std::vector<Vec3> v{Vec3(1, 0, 0), Vec3(-1, 0, 0)};
  std::vector<Vec3> force(2, Vec3::Zero());
  std::vector<Vec3> damping(2, Vec3::Zero());
  add_internal_forces<true>(model, x, v, force, damping);
  CHECK(force[0] == Vec3::Zero());
  CHECK(force[1] == Vec3::Zero());
}

TEST_CASE("Forces are the gradient of the elastic energy") {
  MassSpringModel model =
      test::block(2, 2, 2, 0.1, test::material("m", 1e6, 1000, 0), voxelize::LatticeStyle::corners);
  std::vector<Vec3> x = model.rest;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    x[i] += 0.02 * Vec3(std::sin(3.0 * i), std::cos(5.0 * i), std::sin(7.0 * i + 1));
  const std::vector<Vec3> still(x.size(), Vec3::Zero());
  std::vector<Vec3> force(x.size(), Vec3::Zero());
  std::vector<Vec3> unused(x.size(), Vec3::Zero());
  add_internal_forces<false>(model, x, still, force, unused);
  const double h = 1e-6;
  for (std::uint32_t i = 0; i < model.node_count(); i += 5)
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<Vec3> moved = x;
      moved[i][axis] = x[i][axis] + h;
      const double up = elastic_energy(model, moved);
      moved[i][axis] = x[i][axis] - h;
      const double down = elastic_energy(model, moved);
      CHECK(force[i][axis] == Approx(-(up - down) / (2 * h)).epsilon(1e-6).margin(1e-4));
    }
}

TEST_CASE("The ledger of a coarsely stepped bounce closes to rounding, with and without losses") {
  // The forces of plane and weight are linear, and the spring stays at its rest length. The ledger
  // must therefore close exactly, including the start, contacts that begin and end within a step,
  // friction and damping.
  const double friction = GENERATE(0.0, 0.4);
  const double damping = GENERATE(0.0, 0.01);
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  const auto model = pair_of_nodes(0.001, 0.01);
  Scenario scene;
  scene.obstacles = {test::floor(1e6, friction)};
  scene.obstacles[0].damping = damping;
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.5};
  scene.start.velocity = {0, 3, -1};  // across the spring
  scene.duration = 3;
  RunOptions options;
  options.integrator = integrator;
  const auto t = run(model, scene, options);
  CHECK(closure_error(t.ledger) < 1e-9);
  const auto& end = t.ledger.back();
  CHECK((end.lost_friction > 1) == (friction > 0));
  CHECK((end.lost_contact > 1) == (damping > 0));
}

TEST_CASE("Without damping a bounce on the floor gives the speed back") {
  // Both nodes hit at the same time, so the spring has no effect: 1/2 m v^2 = 1/2 kappa A d^2.
  auto model = pair_of_nodes(0, 0.01);
  Scenario scene = test::weightless(0.2);
  scene.obstacles = {test::floor(1e6, 0)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.1};
  scene.start.velocity = {0, 0, -2};
  const double omega = std::sqrt(1e6 * 0.01 / kMass);
  const double step = 0.01 / omega;  // the loss is proportional to the square of the step
  const auto t = run(model, scene, {.step = step});
  REQUIRE(t.first_contact.has_value());
  CHECK(*t.first_contact == Approx(0.05).margin(2 * step));
  CHECK(t.final.v[0].z() == Approx(2).epsilon(1e-4));
  CHECK(closure_error(t.ledger) < 1e-4);
  double stored = 0;
  for (const auto& entry : t.ledger) stored = std::max(stored, entry.contact);
  CHECK(stored >
        0.5 * kMass * 4);  // in one of the frames, most of 2 x 1/2 m v^2 was stored in the contact
}
