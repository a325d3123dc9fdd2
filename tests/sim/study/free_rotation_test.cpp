#include "sim/study/free_rotation.hpp"

#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

#include "tests/sim/scenes.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

const MassSpringModel& block() {
  return test::small_chain().levels[0].model;  // 5 x 4 x 3: three different moments of inertia
}

}  // namespace

TEST_CASE("A body that spins about a principal axis turns by spin times time") {
  const double spin = 7;
  const auto turned = free_rotation(block(), {.spin = {0, 0, spin}}, 1, 50);
  REQUIRE(turned.size() == 51);
  for (std::size_t f = 0; f < turned.size(); ++f) {
    const double angle = spin * static_cast<double>(f) / 50;
    CHECK((turned[f].col(0) - Vec3(std::cos(angle), std::sin(angle), 0)).norm() < 1e-6);
  }
}

TEST_CASE("Free rotation about any axis keeps momentum and energy") {
  const Mat3 inertia = mass_properties(block()).inertia;
  const Vec3 spin(4, -3, 5);
  const auto turned = free_rotation(block(), {.spin = spin}, 2, 60);
  const Vec3 momentum = inertia * spin;
  for (const Mat3& rotation : turned) {
    CHECK((rotation.transpose() * rotation - Mat3::Identity()).norm() < 1e-9);
    const Vec3 own = inertia.inverse() * rotation.transpose() * momentum;
    CHECK(own.dot(inertia * own) == Approx(spin.dot(momentum)).epsilon(1e-3));
  }
}

TEST_CASE("The difference of two rotations is that of their nodes") {
  const Throw start{.spin = {0, 0, 2}};
  CHECK(rotation_difference(block(), block(), start, 1, 10) == 0);
  CHECK(rotation_difference(block(), block(), {}, 1, 10) == 0);
  // One body of other moments, about an axis that is not a principal one.
  MassSpringModel heavy = block();
  heavy.mass[0] *= 20;
  CHECK(rotation_difference(block(), heavy, {.spin = {1, 2, 2}}, 2, 10) > 0.01);
}
