#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

// Enough steps to detect the slowest instability: at 1.001 of the limit, speeds grow by the factor
// 1.09 per step.
constexpr double kManySteps = 1e5;

/// Level 0 or 1 of a small block of two materials.
MassSpringModel small_body(bool merged, double damping) {
  auto model = test::block(4, 3, 3, 0.1, test::material("m", 1e6, 1000, damping),
                           voxelize::LatticeStyle::centers);
  if (!merged) return model;
  lod::SimplifyOptions options;
  options.levels = 1;
  return lod::simplify(model, options).levels[1].model;
}

/// Rotates at a rate that stretches springs by about 1e-9: linear, but far above rounding.
Scenario stir(double duration) {
  Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.start.spin = {1e-3, 2e-3, 3e-3};
  scene.duration = duration;
  return scene;
}

}  // namespace

TEST_CASE("1e5 steps at 0.90 of the predicted step stay stable, at 1.10 divergence is caught") {
  const bool merged = GENERATE(false, true);
  const double damping = GENERATE(0.0, 0.002);
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  CAPTURE(merged, damping, static_cast<int>(integrator));
  const auto model = small_body(merged, damping);
  const double predicted = predicted_step(model, integrator);

  RunOptions options{.integrator = integrator, .step = 0.9 * predicted, .frame_rate = 0};
  const auto t = run(model, stir(kManySteps * *options.step), options);
  CHECK(t.steps >= static_cast<std::uint64_t>(kManySteps));
  CHECK(t.predicted_step == predicted);
  const auto& end = t.ledger.back();
  CHECK(end.kinetic + end.elastic <= t.ledger.front().total() * (1 + 1e-6));

  options.step = 1.1 * predicted;
  try {
    run(model, stir(kManySteps * *options.step), options);
    FAIL("the divergence went unseen");
  } catch (const UnstableError& e) {
    CHECK(e.node() < model.node_count());
    CHECK(e.time() > 0);
    CHECK(e.time() < 1000 * *options.step);
    CHECK_THAT(e.what(), Catch::Contains("node " + std::to_string(script_number(e.node()))) &&
                             Catch::Contains("kinetic energy") && Catch::Contains("smaller step"));
  }
}

TEST_CASE("The step of the body alone is stable on a floor of any stiffness") {
  const auto model = small_body(false, 0.0);
  Scenario scene;
  scene.obstacles = {test::floor(GENERATE(1e5, 1e9, 1e13), 0.3)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.2};
  scene.start.velocity = {0, 0, -1e-3};
  scene.duration = 0.2;
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4}) {
    CAPTURE(to_string(integrator), *scene.obstacles[0].stiffness);
    const Trajectory t = run(
        model, scene, {.integrator = integrator, .step = 0.9 * predicted_step(model, integrator)});
    CHECK(t.first_contact.has_value());
    // Runge-Kutta damps the vibrations that the impact excites.
    const double first = t.ledger.front().total();
    if (integrator == Integrator::runge_kutta_4)
      CHECK(t.ledger.back().total() < first + 1e-3 * t.ledger.back().kinetic);
    else
      CHECK(closure_error(t.ledger) < 0.01);
  }
}

TEST_CASE("A step far beyond the limit is caught before or as numbers stop being finite") {
  const auto model = test::ball();
  const double factor = GENERATE(3.0, 30.0, 3e4, 1e12);
  const double step = factor * predicted_step(model);
  CHECK_THROWS_AS(run(model, stir(kManySteps * step), {.step = step, .frame_rate = 0}),
                  UnstableError);
}

TEST_CASE("A body at rest, thrown straight up or dropped raises no alarm") {
  const auto model = small_body(false, 0.002);
  Scenario scene;
  scene.duration = 0.5;
  SECTION("at rest without weight") {
    scene.gravity = Vec3::Zero();
  }
  SECTION("let go") {}
  SECTION("thrown up") {
    scene.start.velocity = {0, 0, 2};
  }
  SECTION("far from the origin") {
    scene.gravity = Vec3::Zero();
    scene.start.placed = true;
    scene.start.position = {1e4, -1e4, 1e4};
  }
  CHECK_NOTHROW(run(model, scene));
}
