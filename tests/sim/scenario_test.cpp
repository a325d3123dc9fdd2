#include "sim/scenario.hpp"

#include <string>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

std::string refusal(const Scenario& scenario) {
  try {
    validate(scenario);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

Scenario with_box(const SolidBox& box) {
  Scenario scenario;
  scenario.obstacles.push_back(test::floor(1e6, 0.5));
  scenario.obstacles.push_back(test::floor(1e6, 0.5));
  scenario.obstacles[1].shape = box;
  return scenario;
}

}  // namespace

TEST_CASE("A scenario is refused with the name of its field") {
  CHECK(refusal(test::rods_scene()).empty());
  Scenario s;
  s.duration = 0;
  CHECK_THAT(refusal(s), Catch::Contains("duration"));
  s = {};
  s.gravity.x() = NAN;
  CHECK_THAT(refusal(s), Catch::Contains("gravity"));
  s = {};
  s.start.rotation *= 1.1;
  CHECK_THAT(refusal(s), Catch::Contains("start.rotation"));
  s = {};
  s.start.rotation(0, 0) = -1;  // a mirror
  CHECK_THAT(refusal(s), Catch::Contains("start.rotation"));
  s = {};
  s.stop = StopRule{0, 1};
  CHECK_THAT(refusal(s), Catch::Contains("stop.speed"));
  s = test::rods_scene();
  s.obstacles[1].friction = -0.1;
  CHECK_THAT(refusal(s), Catch::Contains("obstacles[2].friction"));
  s = test::rods_scene();
  s.obstacles[0].shape = Plane{Vec3(0, 0, 2), 0};
  CHECK_THAT(refusal(s), Catch::Contains("obstacles[1].normal"));
  s = with_box({.half_size = Vec3(1, 0, 1)});
  CHECK_THAT(refusal(s), Catch::Contains("obstacles[2].half_size"));
  s = test::rods_scene();
  s.measure_from = "ceiling";
  CHECK_THAT(refusal(s), Catch::Contains("measure_from") && Catch::Contains("ceiling"));
}

TEST_CASE("A throw turns the body about its centre of mass and sets it moving") {
  const auto model = test::rods();
  Throw start;
  start.rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  start.placed = true;
  start.position = {1, -2, 5};
  start.velocity = {3, 0, 1};
  start.spin = {0.5, 6, -1};
  const State state = initial_state(model, start);
  const auto rest = mass_properties(model);
  MassSpringModel placed = model;
  placed.rest = state.x;
  CHECK((mass_properties(placed).center - start.position).norm() < 1e-12);
  Vec3 momentum = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    momentum += model.mass[i] * state.v[i];
    angular += model.mass[i] * (state.x[i] - start.position).cross(state.v[i]);
  }
  CHECK((momentum / rest.mass - start.velocity).norm() < 1e-12);
  const Mat3 inertia = start.rotation * rest.inertia * start.rotation.transpose();
  CHECK((angular - inertia * start.spin).norm() < 1e-9 * angular.norm());

  start = {};
  CHECK((initial_state(model, start).x == model.rest));
}

TEST_CASE("The distance from a turned box is signed and its normal points away") {
  Obstacle obstacle;
  SolidBox box;
  box.center = {1, 2, 3};
  box.half_size = {1, 2, 0.1};
  box.rotation = Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  obstacle.shape = box;
  const auto at = [&](const Vec3& local) {
    return surface_distance(obstacle, box.center + box.rotation * local);
  };
  CHECK(at({0, 0, 0.5}).distance == Approx(0.4));
  CHECK((at({0, 0, 0.5}).normal - box.rotation.col(2)).norm() < 1e-12);
  CHECK(at({0.2, 0.3, -0.06}).distance == Approx(-0.04));
  CHECK((at({0.2, 0.3, -0.06}).normal + box.rotation.col(2)).norm() < 1e-12);
  CHECK(at({1.3, 2.4, 0}).distance == Approx(0.5));
  CHECK((at({1.3, 2.4, 0}).normal - box.rotation * Vec3(0.6, 0.8, 0)).norm() < 1e-12);
}
