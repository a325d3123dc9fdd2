#include "sim/held/rigid_path.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace springlod;
using namespace springlod::sim;

TEST_CASE("A path passes through its poses and rests at both ends") {
  const RigidPath path({{.time = 0.5, .move = {0.1, 0, -0.2}, .turn = {0, 0, 1}},
                        {.time = 2, .move = {0.1, 0.3, 0.4}, .turn = {0, 0, 9}}});
  CHECK_FALSE(path.is_still());
  const RigidPath::Pose middle = path.at(0.5);
  CHECK((middle.move - Vec3(0.1, 0, -0.2)).norm() < 1e-15);
  CHECK((middle.rotation * Vec3::UnitX() - Vec3(std::cos(1), std::sin(1), 0)).norm() < 1e-15);
  CHECK(path.at(0).velocity.norm() == 0);
  CHECK(path.at(0).move.norm() == 0);
  for (const double late : {2.0, 5.0}) {
    CHECK((path.at(late).move - Vec3(0.1, 0.3, 0.4)).norm() < 1e-15);
    CHECK((path.at(late).rotation * Vec3::UnitX() - Vec3(std::cos(9), std::sin(9), 0)).norm() <
          1e-14);
    CHECK(path.at(late).velocity.norm() < 1e-14);
    CHECK(path.at(late).spin.norm() < 1e-13);
  }
  CHECK(RigidPath({}).is_still());
}

TEST_CASE("No component of a path overshoots its poses, and a pause is one") {
  const RigidPath path({{.time = 1, .move = {1, 0, 0}},
                        {.time = 2, .move = {1, 2, 0}},
                        {.time = 2.1, .move = {1.5, 2.5, 0}}});
  double x = 0;
  double y = 0;
  for (int i = 0; i <= 2100; ++i) {
    const RigidPath::Pose pose = path.at(i * 1e-3);
    CHECK(pose.move.x() >= x - 1e-15);
    CHECK(pose.move.y() >= y - 1e-15);
    if (i >= 1000 && i <= 2000) CHECK(pose.move.x() == Approx(1).margin(1e-14));
    x = pose.move.x();
    y = pose.move.y();
  }
}

TEST_CASE("The velocities of a path are those of its points") {
  const RigidPath path({{.time = 0.4, .move = {0.1, 0.2, 0}, .turn = {0.5, -1, 2}},
                        {.time = 1, .move = {-0.1, 0.3, 1}, .turn = {3, 1, 2.5}}});
  const Vec3 arm(0.3, -0.7, 0.2);
  const auto point = [&](double time) -> Vec3 {
    const RigidPath::Pose pose = path.at(time);
    return pose.move + pose.rotation * arm;
  };
  constexpr double kSmall = 1e-6;
  for (const double time : {1e-5, 0.1, 0.39, 0.41, 0.7, 0.99}) {
    const RigidPath::Pose pose = path.at(time);
    const Vec3 found = pose.velocity + pose.spin.cross(pose.rotation * arm);
    const Vec3 wanted = (point(time + kSmall) - point(time - kSmall)) / (2 * kSmall);
    CHECK((found - wanted).norm() < 1e-8);
  }
}
