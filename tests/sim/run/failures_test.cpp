// Runs that must fail: each failure is detected and reported with its cause.
#include <algorithm>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run.hpp"
#include "sim/study/stiffness_ratio.hpp"
#include "tests/sim/scenes.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

MassSpringModel cube(double damping = 0) {
  return test::block(3, 3, 3, 0.1, test::material("m", 1e5, 1000, damping),
                     voxelize::LatticeStyle::corners);
}

/// A block thrown along x at a wall of the given thickness.
Scenario wall_scene(double thickness, double speed, double stiffness) {
  Scenario scene = test::weightless(0.1);
  Obstacle wall;
  wall.name = "thin wall";
  wall.shape = SolidBox{{0.6, 0.15, 0.15}, {thickness / 2, 1, 1}, Mat3::Identity()};
  wall.stiffness = stiffness;
  scene.obstacles = {wall};
  scene.start.velocity = {speed, 0, 0};
  return scene;
}

TunnelError tunnelling(const MassSpringModel& model, const Scenario& scene,
                       const RunOptions& options) {
  try {
    run(model, scene, options);
  } catch (const TunnelError& e) {
    return e;
  }
  FAIL("no node went through");
  throw;
}

}  // namespace

TEST_CASE("A fast body that jumps a thin wall in a step is stopped by name under every scheme") {
  const MassSpringModel model = cube();
  const Scenario scene = wall_scene(0.002, 40, 1e5);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    RunOptions options{.integrator = integrator, .step = 2e-4, .frame_rate = 0};
    // The implicit schemes evaluate contact at the end of a step and push back; their steps are
    // longer.
    if (is_implicit(integrator)) options.step = 5e-4;
    try {
      run(model, scene, options);
      // A body that is pushed back out on the side it came from is also correct.
      CHECK(is_implicit(integrator));
    } catch (const TunnelError& e) {
      CHECK(e.node() < model.node_count());
      CHECK(e.obstacle() == "thin wall");
      CHECK(e.time() > 0.004);
      CHECK(e.time() < 0.02);
      CHECK_THAT(e.what(), Catch::Contains("node " + std::to_string(script_number(e.node()))) &&
                               Catch::Contains("\"thin wall\"") && Catch::Contains("take a step"));
    }
  }
}

TEST_CASE("The stiffness that the tunnelling message advises keeps the body out, with any step") {
  const MassSpringModel model = cube();
  const RunOptions jumps{.step = 2e-3};  // 8 cm, through a wall of 2 cm
  const TunnelError e = tunnelling(model, wall_scene(0.02, 40, 1e6), jumps);
  CHECK_THAT(e.what(), Catch::Contains("give it more stiffness") &&
                           Catch::Contains("or take a step below 0.0002"));
  // Stiff enough to stop 40 m/s within half the thickness of the wall: each surface node has 1 kg
  // and 0.0025 m2.
  CHECK_NOTHROW(run(model, wall_scene(0.02, 40, 3e9), jumps));
}

TEST_CASE("A body pushed through a wall too soft to hold it is stopped, with other advice") {
  const MassSpringModel model = cube();
  const TunnelError e = tunnelling(model, wall_scene(0.05, 20, 1e4), {});
  CHECK_THAT(e.what(), Catch::Contains("too soft to hold"));
}

TEST_CASE("A path over the edge, a corner cut and a rest on top of a box are no tunnels") {
  MassSpringModel model = cube();
  model.contact_area.assign(model.node_count(), 0);
  model.contact_area[0] = 1;
  Obstacle box;
  box.name = "box";
  box.shape = SolidBox{Vec3::Zero(), {1, 0.5, 0.1}, Mat3::Identity()};
  std::vector<Vec3> x = model.rest;
  const auto follow = [&](const std::vector<Vec3>& path) {
    x[0] = path.front();
    const ContactPoints points(model);
    TunnelCheck watch(points, {box}, x);
    for (const Vec3& place : path) {
      x[0] = place;
      watch.check(x, 1, 0.1);
    }
  };
  CHECK_NOTHROW(follow({{0, 0, 0.11}, {0, 0, 0.05}, {0, 0, 0.02}, {0, 0, 0.12}}));
  CHECK_NOTHROW(follow({{0.9, 0, 0.11}, {0.95, 0, 0.09}, {1.2, 0, 0.05}, {1.2, 0, -0.5}}));
  CHECK_NOTHROW(follow({{0.95, 0, 0.2}, {1.2, 0, -0.05}}));
  CHECK_NOTHROW(follow({{0, 0, 0.05}, {0, 0, 0.2}, {2, 0, 0.2}, {2, 0, -1}, {0, 0, -0.2}}));
  CHECK_THROWS_AS(follow({{0, 0, 0.11}, {0, 0, -0.11}}), TunnelError);
  CHECK_THROWS_AS(follow({{0, 0, 0.11}, {0, 0, 0.05}, {0, 0, -0.05}, {0, 0, -0.2}}), TunnelError);
  // Inside the box from the start, nearest to the top.
  CHECK_THROWS_AS(follow({{0, 0, 0.05}, {0, 0, -0.2}}), TunnelError);
  CHECK_THROWS_AS(follow({{-3, 0.1, 0}, {3, 0.1, 0}}), TunnelError);
}

TEST_CASE("A step beyond the limit of damping is reported as caused by damping") {
  const MassSpringModel model = cube(0.1);
  const Scenario scene = [] {
    Scenario stir = test::weightless(1);
    stir.start.spin = {1, 2, 3};
    return stir;
  }();
  for (const Integrator integrator :
       {Integrator::symplectic_euler, Integrator::velocity_verlet, Integrator::runge_kutta_4}) {
    CAPTURE(to_string(integrator));
    const StepLimit limit = step_limit(model, integrator);
    CHECK(limit.limited_by() == StepBound::damping);
    CHECK(limit.step < 0.5 * limit.without_damping);
    const auto at = [&](double part) {
      return RunOptions{.integrator = integrator, .step = part * limit.step, .frame_rate = 0};
    };
    CHECK_NOTHROW(run(model, scene, at(0.9)));
    CHECK_THROWS_WITH(
        run(model, scene, at(1.2)),
        Catch::Contains("damping is what bounds the step") && Catch::Contains("less damping"));
  }
  const StepLimit light = step_limit(cube(1e-4));
  CHECK(light.limited_by() == StepBound::springs);
  CHECK_THROWS_WITH(run(cube(1e-4), scene, {.step = 1.2 * light.without_damping}),
                    Catch::Contains("beyond the limit") && !Catch::Contains("damping"));
}

TEST_CASE("A spring of no length is refused by its number, not run") {
  MassSpringModel model = cube();
  const Scenario scene = test::weightless(0.1);
  SECTION("two nodes in one place") {
    model.rest[model.b[5]] = model.rest[model.a[5]];
    CHECK_THROWS_WITH(run(model, scene),
                      Catch::Contains("spring 6") && Catch::Contains("nodes coincide"));
  }
  SECTION("a rest length of 0") {
    model.rest_length[7] = 0;
    CHECK_THROWS_WITH(run(model, scene),
                      Catch::Contains("spring 8") && Catch::Contains("rest length"));
  }
}

TEST_CASE("Nodes that go past each other in a run are reported, under every scheme") {
  MassSpringModel model = cube();
  const bool has_corners = GENERATE(false, true);
  if (!has_corners) model.corners.clear();
  Scenario scene = test::weightless(0.05);
  State start = rest_state(model);
  // Two neighbours move towards each other, through each other and far beyond.
  start.v[0] = {25, 0, 0};
  start.v[1] = {-25, 0, 0};
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    const Trajectory wild =
        run(model, scene, start,
            {.integrator = integrator, .step = 1e-4, .frame_rate = 0, .volumes = false});
    REQUIRE(wild.first_crossing.has_value() == !has_corners);
    REQUIRE(wild.inversions.first.has_value() == has_corners);
    if (has_corners) {
      // Two nodes 10 cm apart meet after 2 ms at 25 m/s each; springs slow them down a little.
      CHECK(wild.inversions.first->time > 1.5e-3);
      CHECK(wild.inversions.first->time < 4e-3);
      CHECK(wild.inversions.most >= 1);
    } else {
      CHECK(wild.first_crossing->a == 0);
      CHECK(wild.first_crossing->time > 0);
    }
    for (const Vec3& x : wild.final.x) CHECK(x.allFinite());
  }
  scene.start.spin = {0, 0, 300};  // a fast rotation is not an inversion
  scene.duration = 0.02;
  const Trajectory turning = run(model, scene, {.step = 1e-4});
  CHECK_FALSE(turning.first_crossing.has_value());
  CHECK_FALSE(turning.inversions.first.has_value());
}

TEST_CASE("Conjugate gradients that run out of iterations are reported, not taken for a solution") {
  const MassSpringModel model = test::rods();
  const LodChain chain =
      with_stiffness_ratio({.levels = {Level{model, identity_groups(model.node_count()), "base"}}},
                           stiff_part(model), 1e5);
  const MassSpringModel& uneven = chain.levels[0].model;
  Scenario scene = test::weightless(0.05);
  scene.start.spin = {4, 2, 1};
  RunOptions options{.integrator = Integrator::backward_euler_cg, .step = 5e-3, .frame_rate = 0};
  options.solver.linear_iterations = 5;
  options.solver.iterations = 3;
  const Trajectory cut_short = run(uneven, scene, options);
  CHECK(cut_short.unconverged_steps > 0);
  CHECK(cut_short.unconverged_steps <= cut_short.steps);
  options.solver = {};
  CHECK(run(uneven, scene, options).unconverged_steps == 0);
  options.integrator = Integrator::backward_euler_direct;
  CHECK(run(uneven, scene, options).unconverged_steps == 0);
}

TEST_CASE("Single precision is refused by every integrator that has no such kernel") {
  const MassSpringModel model = cube();
  const Scenario scene = test::weightless(0.01);
  for (const Integrator integrator : all_choices<Integrator>()) {
    CAPTURE(to_string(integrator));
    const RunOptions options{.integrator = integrator,
                             .step = 1e-3,
                             .frame_rate = 0,
                             .precision = Precision::single_precision};
    if (integrator == Integrator::symplectic_euler)
      CHECK_NOTHROW(run(model, scene, options));
    else
      CHECK_THROWS_WITH(run(model, scene, options),
                        Catch::Contains("integrator = \"" + std::string(to_string(integrator)) +
                                        "\" computes in double precision only") &&
                            Catch::Contains("leave out precision = \"single\", or use") &&
                            Catch::Contains("\"symplectic_euler\""));
  }
}
