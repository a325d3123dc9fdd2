// Contact at the points of a body's surface, which its nodes do not lie on.
#include "sim/contact/body_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <catch2/catch.hpp>

#include "lod/build.hpp"
#include "sim/contact/contact_points.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"
#include "tests/support/cut_ball.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

constexpr double kRadius = 0.5;

Obstacle plate(double friction) {
  Obstacle plate = test::floor(1, friction);
  plate.stiffness.reset();
  return plate;
}

/// A ball above a plate, thrown.
Scenario on_plate(double gap, const Vec3& velocity, double friction, double duration) {
  Scenario scene = test::weightless(duration);
  scene.obstacles = {plate(friction)};
  scene.start.placed = true;
  scene.start.position = {0, 0, kRadius + gap};
  scene.start.velocity = velocity;
  return scene;
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double value : values) total += value;
  return total;
}

}  // namespace

TEST_CASE("A body without a contact surface touches obstacles at its nodes with an area") {
  const MassSpringModel model = test::block(3, 3, 3, voxelize::LatticeStyle::corners);
  const BodySurface surface = body_surface(model);
  std::uint32_t p = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (!(model.contact_area[i] > 0)) continue;
    CHECK(surface.node[p] == i);
    CHECK(surface.position[p] == model.rest[i]);
    CHECK(surface.area[p] == model.contact_area[i]);
    ++p;
  }
  CHECK(surface.count() == p);
  CHECK(ContactPoints(model).name(0) == "node 1");
}

TEST_CASE("The contact of a point is four times as stiff as the cells under it") {
  const MassSpringModel model = test::cut_ball(9);
  const BodySurface surface = body_surface(model);
  REQUIRE(surface.count() == model.surface.count());
  for (std::uint32_t p = 0; p < surface.count(); ++p) {
    CHECK(surface.contact[p] == Approx(4 * model.surface.stiffness[p]));
    CHECK(surface.position[p].norm() == Approx(kRadius).epsilon(5e-3));
  }
  const ContactPoints points(model);
  CHECK(points.count() == surface.count());
  CHECK(points.name(0) == "the surface at node " + std::to_string(surface.node[0] + 1));
}

TEST_CASE("The skins of levels have the area and the stiffness of the points of the base") {
  const MassSpringModel base = test::cut_ball(9);
  const LodChain chain = lod::simplify(base, {.levels = 2});
  for (std::uint32_t level = 0; level <= 2; ++level) {
    CAPTURE(level);
    const ContactSkin skin = contact_skin(chain, level);
    const MassSpringModel& model = chain.levels[level].model;
    validate(skin, model.node_count());
    CHECK(skin.area.size() == base.surface.count());
    CHECK(sum(skin.area) == Approx(sum(base.surface.area)));
    CHECK(sum(skin.contact) == Approx(4 * sum(base.surface.stiffness)));
    for (const Vec3& at : interpolate(skin.of_nodes, model.rest))
      CHECK(at.norm() == Approx(kRadius).epsilon(0.06));
    CHECK((level == 0) != model.surface.empty());
  }
}

TEST_CASE("A ball of cut cells bounces with its speed, after the time of Hertz's contact") {
  const MassSpringModel model = test::cut_ball(12);
  const double young = 1e6, density = 1000;
  const double speed = 0.0139 * std::sqrt(young / density);  // indents by 0.05 R
  const double mass = mass_properties(model).mass;
  const double modulus = young / (1 - 0.25 * 0.25);
  const double hertz = 2.87 * std::pow(mass * mass / (kRadius * modulus * modulus * speed), 1. / 5);
  const double finite = 0.916;  // of a ball that deforms as a whole: docs/validation.md
  const double gap = 0.002;
  Scenario scene = on_plate(gap, {0, 0, -speed}, 0, gap / speed + 1.5 * hertz);
  RunOptions options;
  options.frame_rate = 400 / hertz;
  const Trajectory result = run(model, scene, options);
  double first = -1, last = -1;
  for (const LedgerEntry& entry : result.ledger)
    if (entry.contact > 1e-6 * entry.total()) {
      if (first < 0) first = entry.time;
      last = entry.time;
    }
  CHECK((last - first) / hertz == Approx(finite).epsilon(0.05));
  const Vec3 after = center_of_mass(model, result.final.v);
  CHECK(after.z() / speed == Approx(1).epsilon(0.02));
}

TEST_CASE("A ball of cut cells rolls evenly along a floor, at five sevenths of its speed") {
  const MassSpringModel model = test::cut_ball(8.6);
  const double speed = 1;
  Scenario scene = on_plate(0, {speed, 0, 0}, 0.5, 2);
  scene.gravity = {0, 0, -1};  // it sinks in by a hundredth of its radius
  RunOptions options;
  options.frame_rate = 20;
  const Trajectory result = run(model, scene, options);
  CHECK(center_of_mass(model, result.final.v).x() / speed == Approx(5. / 7).epsilon(0.05));
  // It neither hops nor sinks while it rolls.
  double lowest = 1, highest = 0;
  for (const Frame& frame : result.frames) {
    if (frame.time < 0.8) continue;  // it slides first
    const double height = center_of_mass(model, frame.x).z() / kRadius;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  CHECK(highest - lowest < 0.04);
  CHECK(closure_error(result.ledger) < 0.02);
}

TEST_CASE("Both layouts give a body with a contact surface the same run, for any threads") {
  const MassSpringModel model = test::cut_ball(8, 0.4);
  Scenario scene = on_plate(0.01, {0.5, 0, -1}, 0.5, 0.1);
  RunOptions options;
  options.layout = Layout::any_shape;
  const Trajectory quads = run(model, scene, options);
  options.layout = Layout::fastest;
  const Trajectory rows = run(model, scene, options);
  options.threads = 2;
  const Trajectory threads = run(model, scene, options);
  double largest = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    largest = std::max(largest, (quads.final.x[i] - rows.final.x[i]).norm());
    CHECK(rows.final.x[i] == threads.final.x[i]);
  }
  CHECK(largest < 1e-9);
  CHECK(rows.first_contact.has_value());
}

TEST_CASE("A ball of cut cells that lies on a floor stays there, with every integrator") {
  const MassSpringModel model = test::cut_ball(5.5);
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4,
        Integrator::backward_euler_cg, Integrator::backward_euler_direct, Integrator::xpbd,
        Integrator::projective_dynamics}) {
    CAPTURE(static_cast<int>(integrator));
    Scenario scene = on_plate(0, Vec3::Zero(), 0.5, 0.2);
    scene.gravity = {0, 0, -9.81};
    RunOptions options;
    options.integrator = integrator;
    options.sleep = 0;
    const Trajectory result = run(model, scene, options);
    const Vec3 center = center_of_mass(model, result.final.x);
    CHECK(center.z() / kRadius == Approx(1).epsilon(0.08));
    CHECK(center.head<2>().norm() < 0.01 * kRadius);
  }
}
