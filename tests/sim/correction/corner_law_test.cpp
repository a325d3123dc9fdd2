#include "sim/correction/corner_law.hpp"

#include <catch2/catch.hpp>

#include "tests/support/lattices.hpp"
#include "tests/support/models.hpp"

using namespace springlod;
using namespace springlod::sim;

namespace {

constexpr double kEdge = 0.02;  // [m]
constexpr double kYoung = 3e5;  // [Pa]

/// One corner of a cell.
MassSpringModel one_corner() {
  MassSpringModel model = test::make_model({{0, 0, 0}, {kEdge, 0, 0}, {0, kEdge, 0}, {0, 0, kEdge}},
                                           {{0, 1}, {0, 2}, {0, 3}});
  model.corners = {Corner{{0, 1, 2, 3}, kYoung}};
  return model;
}

/// The corner with J = ratio, by its height.
std::vector<Vec3> flattened(const MassSpringModel& model, double ratio) {
  std::vector<Vec3> x = model.rest;
  x[3].z() *= ratio;
  return x;
}

}  // namespace

TEST_CASE("A corner has no energy down to kCornerResists, and K d^2 / 2 below") {
  const MassSpringModel model = one_corner();
  const double rest = kEdge * kEdge * kEdge;
  const double stiffness = 100 * kYoung * rest / 8;
  CHECK(corner_stiffness(model.corners[0], rest) == Approx(stiffness).epsilon(1e-14));
  for (const double ratio : {1.5, 1.0, 0.6, kCornerResists + 1e-12})
    CHECK(corner_energy(model, flattened(model, ratio)) == 0);
  for (const double ratio : {0.4 - 1e-6, 0.3, 0.1, 0.0, -0.2, -1.0}) {
    const double depth = 0.4 - ratio;
    CHECK(corner_energy(model, flattened(model, ratio)) ==
          Approx(0.5 * stiffness * depth * depth).epsilon(1e-9));
  }
}

TEST_CASE("The energy of corners is that of each, in proportion to modulus and volume") {
  MassSpringModel model = one_corner();
  const double one = corner_energy(model, flattened(model, 0));
  model.corners[0].young *= 3;
  CHECK(corner_energy(model, flattened(model, 0)) == Approx(3 * one));
  model.corners.push_back(model.corners[0]);
  CHECK(corner_energy(model, flattened(model, 0)) == Approx(6 * one));
  for (Vec3& x : model.rest) x *= 2;
  CHECK(corner_energy(model, flattened(model, 0)) == Approx(8 * 6 * one));
}

TEST_CASE("The gradient of the volume is that of finite differences") {
  std::mt19937_64 random(1);
  const auto random_vector = [&] {
    return Vec3(test::uniform(random), test::uniform(random), test::uniform(random));
  };
  for (int draw = 0; draw < 20; ++draw) {
    CornerNodes at;
    for (Vec3& x : at) x = random_vector();
    const Corner corner{{0, 1, 2, 3}, kYoung};
    CHECK(volume_at(at) == Approx(corner_volume(corner, {at.begin(), at.end()})));
    const CornerNodes gradient = volume_gradient(at);
    Vec3 sum = Vec3::Zero();
    for (std::size_t node = 0; node < 4; ++node) {
      sum += gradient[node];
      for (int axis = 0; axis < 3; ++axis) {
        // The volume is linear in each coordinate, so any difference is exact.
        constexpr double kDifference = 0.5;
        CornerNodes moved = at;
        moved[node][axis] += kDifference;
        CHECK(gradient[node][axis] ==
              Approx((volume_at(moved) - volume_at(at)) / kDifference).margin(1e-13));
      }
    }
    CHECK(sum.norm() < 1e-15 * 100);
  }
}
