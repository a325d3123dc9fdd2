#include "sim/run.hpp"

#include <cmath>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "sim/scenario.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

TEST_CASE("The energy ledger closes within 1 % for the ball rolling on the floor") {
  const auto model = test::ball();
  REQUIRE(model.node_count() == 281);
  const auto integrator = GENERATE(Integrator::symplectic_euler, Integrator::velocity_verlet);
  const auto t = run(model, test::ball_scene(), {.integrator = integrator});
  CHECK(closure_error(t.ledger) < 0.01);
  const auto& end = t.ledger.back();
  CHECK(end.lost_damping > 0);
  CHECK(end.lost_friction > 0);
  // The floor has no damping: lost_contact holds only the discretization error of contacts.
  CHECK(std::abs(end.lost_contact) < 0.01 * end.lost_damping);
  CHECK(t.ledger.size() == t.frames.size());
}

TEST_CASE("The energy ledger closes within 1 % for the rods thrown at the wall") {
  const auto model = test::rods();
  REQUIRE(model.end_count() == 4748);
  Scenario scene = test::rods_scene();
  const auto t = run(model, scene);
  CHECK(closure_error(t.ledger) < 0.01);
  CHECK(t.ledger.back().lost_friction > 0);
  for (Obstacle& obstacle : scene.obstacles) obstacle.damping = 0.0005;
  const auto damped = run(model, scene);
  CHECK(closure_error(damped.ledger) < 0.01);
  CHECK(damped.ledger.back().lost_contact > 10 * t.ledger.back().lost_contact);
}

TEST_CASE("The ledger sees a mechanism that is left out") {
  // If one loss were computed as the remainder of the others, the sum would also close without it.
  auto t = run(test::rods(), test::rods_scene());
  auto without = t.ledger;
  for (auto& entry : without) entry.lost_damping = 0;
  CHECK(closure_error(without) > 0.1);
  without = t.ledger;
  for (auto& entry : without) entry.lost_friction = 0;
  CHECK(closure_error(without) > 0.1);
}

TEST_CASE("The ledger costs nothing in the result: the trajectory keeps its bits") {
  const auto model = test::rods();
  Scenario scene = test::rods_scene();
  scene.duration = 0.5;
  const auto with = run(model, scene);
  const auto without = run(model, scene, {.ledger = false});
  CHECK((with.final.x == without.final.x));
  CHECK((with.final.v == without.final.v));
  CHECK(without.ledger.empty());
}

TEST_CASE("The step is safety times the predicted one and fits the duration") {
  const auto model = test::rods();
  Scenario scene = test::rods_scene();
  scene.duration = 0.1;
  const auto t = run(model, scene);
  CHECK(t.step <= 0.8 * t.predicted_step);
  CHECK(t.step > 0.79 * t.predicted_step);
  CHECK(static_cast<double>(t.steps) * t.step == Approx(0.1).epsilon(1e-12));
  CHECK(t.spring_updates == t.steps * model.spring_count());
  CHECK(run(model, scene, {.step = 1e-4}).step == 1e-4);
}

TEST_CASE("A run names what determines its step") {
  const Scenario scene = test::weightless(1);
  const auto damped = [](double time) {
    return test::block(3, 3, 3, 0.1, test::material("m", 1e6, 1000, time),
                       voxelize::LatticeStyle::corners);
  };
  const auto bound = [&](const MassSpringModel& model, const RunOptions& options) {
    return run(model, scene, options).limited_by;
  };
  const MassSpringModel light = damped(1e-5);
  CHECK(bound(light, {}) == StepBound::springs);
  CHECK(bound(damped(0.1), {}) == StepBound::damping);
  CHECK(bound(damped(0.1), {.step = 1e-5}) == StepBound::asked);
  CHECK(bound(light, {.integrator = Integrator::backward_euler_cg, .step = 1e-3}) ==
        StepBound::asked);
  const Scenario blink = test::weightless(1e-3);
  CHECK(run(light, blink).limited_by == StepBound::duration);
  CHECK(run(light, blink, {.integrator = Integrator::xpbd}).limited_by == StepBound::duration);
  CHECK(run(light, scene, {.integrator = Integrator::xpbd}).limited_by == StepBound::scheme);
}

TEST_CASE("A run has the stable step without damping") {
  const Scenario scene = test::weightless(0.1);
  const auto block = [](double time) {
    return test::block(3, 3, 3, 0.1, test::material("m", 1e6, 1000, time),
                       voxelize::LatticeStyle::corners);
  };
  const Trajectory undamped = run(block(0), scene);
  const Trajectory damped = run(block(0.1), scene);
  CHECK(undamped.undamped_step == undamped.predicted_step);
  CHECK(damped.undamped_step == Approx(undamped.predicted_step));
  CHECK(damped.predicted_step < 0.02 * damped.undamped_step);
  CHECK(std::isinf(run(block(0), scene, {.integrator = Integrator::xpbd}).undamped_step));
}

TEST_CASE("Frames lie at the frame times, first and last state included") {
  const auto model = test::rods();
  Scenario scene;
  scene.start.velocity = {1, 0, 0};
  scene.gravity = Vec3::Zero();
  scene.duration = 0.55;
  auto t = run(model, scene, {.frame_rate = 10});
  REQUIRE(t.frames.size() == 7);
  for (std::size_t f = 0; f < 6; ++f) {
    CHECK(t.frames[f].time == Approx(0.1 * static_cast<double>(f)).margin(1e-15));
    CHECK(t.frames[f].x[5].x() == Approx(model.rest[5].x() + t.frames[f].time).margin(1e-9));
  }
  CHECK(t.frames.back().time == Approx(0.55));
  CHECK((t.frames.back().x == t.final.x));
  CHECK((t.frames.front().x == model.rest));
  scene.duration = 0.5;  // the last frame is the last state and occurs once
  CHECK(run(model, scene, {.frame_rate = 10}).frames.size() == 6);
  CHECK(run(model, scene, {.frame_rate = 0}).frames.size() == 2);
  // More frames than steps.
  t = run(model, scene, {.step = 0.0004, .frame_rate = 10000});
  CHECK(t.frames.size() == 5001);
  CHECK(t.ledger.size() == 5001);
}

TEST_CASE("A stop rule ends the run once the body has been slow for long enough") {
  auto model = test::block(6, 6, 2, 0.1, test::material("m", 1e6, 1000, 0.002),
                           voxelize::LatticeStyle::corners);
  Scenario scene;
  scene.gravity = {0, 0, -10};
  scene.obstacles = {test::floor(1e7, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.1};
  scene.start.velocity = {1, 0, 0};  // slides for 0.2 s; below 0.1 m/s from 0.18 s on
  scene.duration = 5;
  scene.stop = StopRule{0.1, 0.3};
  const auto t = run(model, scene);
  CHECK(t.simulated > 0.47);
  CHECK(t.simulated < 0.6);
  CHECK(t.frames.back().time == t.simulated);
  CHECK(t.final.t == t.simulated);
  scene.stop.reset();
  scene.duration = 1;
  CHECK(run(model, scene).simulated == Approx(1));
}

TEST_CASE("A run may end a given time after the first contact, with the same frames until then") {
  const auto& model = test::small_chain().levels[1].model;
  const Scenario scene = test::small_scene(1.5);
  const auto whole = run(model, scene);
  const auto cut = run(model, scene, {.stop_after_contact = 0.1});
  REQUIRE(whole.first_contact);
  CHECK(cut.first_contact == whole.first_contact);
  CHECK(cut.simulated > *cut.first_contact + 0.1);
  CHECK(cut.simulated < *cut.first_contact + 0.2);
  for (std::size_t f = 0; f + 1 < cut.frames.size(); ++f)
    CHECK((cut.frames[f].x == whole.frames[f].x));
  CHECK(cut.processor_seconds > 0);
  CHECK(cut.processor_seconds <= cut.wall_seconds);

  Scenario flight = scene;
  flight.obstacles.clear();
  CHECK(run(model, flight, {.stop_after_contact = 0.1}).simulated == Approx(1.5));
}

TEST_CASE("The distance is measured from the named obstacle or along the ground") {
  Scenario scene = test::rods_scene();
  CHECK(measured_distance(scene, {0, 0, 2}, {-1.5, 3, 0.2}) == Approx(3.5));
  scene.measure_from = "floor";
  CHECK(measured_distance(scene, {0, 0, 2}, {-1.5, 3, 0.2}) == Approx(0.2));
  scene.measure_from = "";
  CHECK(measured_distance(scene, {1, 0, 2}, {4, 4, 0.2}) == Approx(5));
}

TEST_CASE("Wrong run options are refused by name") {
  const auto model = test::ball();
  CHECK_THROWS_WITH(run(model, {}, {.step = -1.0}), Catch::Contains("step"));
  CHECK_THROWS_WITH(run(model, {}, {.step = 1e-30}), Catch::Contains("take a longer step"));
  CHECK_THROWS_WITH(run(model, {}, {.integrator = Integrator::backward_euler_cg, .step = 3}),
                    Catch::Contains("longer than the duration"));
  CHECK_THROWS_WITH(run(model, {}, {.safety = 1.5}), Catch::Contains("safety"));
  CHECK_THROWS_WITH(run(model, {}, {.frame_rate = -1}), Catch::Contains("frame_rate"));
  Scenario scene;
  scene.duration = -1;
  CHECK_THROWS_AS(run(model, scene), InputError);
}

TEST_CASE("A single free node flies without any stiffness to take a step from") {
  MassSpringModel m;
  m.rest = {Vec3::Zero()};
  m.mass = m.volume = {1};
  m.contact_area = {0};
  m.border = {1};
  m.material = {0};
  m.materials = {Material{.name = "m"}};
  Scenario scene;
  scene.start.velocity = {1, 0, 5};
  const auto t = run(m, scene);
  CHECK(std::isinf(t.predicted_step));
  CHECK((t.final.x[0] - Vec3(1, 0, 5 - 9.81 / 2)).norm() < 1e-12);
}
