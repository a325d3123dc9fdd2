#include "sim/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::sim {
namespace {

// Tolerance of a unit vector or a rotation [1]: the rounding error of 6 digits in a script.
constexpr double kUnitTolerance = 1e-6;

void require(bool ok, std::string_view field, std::string_view rule) {
  if (!ok) throw InputError(fmt::format("scenario: {} must be {}", field, rule));
}

void require_rotation(const Mat3& rotation, const std::string& field) {
  const bool orthonormal =
      (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff() < kUnitTolerance;
  require(orthonormal && rotation.determinant() > 0, field,
          "a rotation (orthonormal columns, determinant 1)");
}

void validate(const Plane& plane, const std::string& field) {
  require(std::abs(plane.normal.norm() - 1) < kUnitTolerance, field + ".normal",
          "a vector of length 1");
  require(std::isfinite(plane.offset), field + ".offset", "finite");
}

void validate(const SolidBox& box, const std::string& field) {
  require(box.center.allFinite(), field + ".center", "finite");
  require(box.half_size.allFinite() && box.half_size.minCoeff() > 0, field + ".half_size",
          "above 0 along every axis");
  require_rotation(box.rotation, field + ".rotation");
}

void validate(const Obstacle& obstacle, const std::string& field) {
  std::visit([&](const auto& shape) { validate(shape, field); }, obstacle.shape);
  if (obstacle.stiffness)
    require(std::isfinite(*obstacle.stiffness) && *obstacle.stiffness > 0, field + ".stiffness",
            "\"auto\" or a finite number of N/m3 above 0");
  require(std::isfinite(obstacle.friction) && obstacle.friction >= 0, field + ".friction",
          "a finite number, 0 or more");
  require(std::isfinite(obstacle.damping) && obstacle.damping >= 0, field + ".damping",
          "a finite number of seconds, 0 or more");
}

void validate(const Throw& start) {
  require_rotation(start.rotation, "start.rotation");
  require(start.position.allFinite(), "start.position", "finite");
  require(start.velocity.allFinite(), "start.velocity", "finite");
  require(start.spin.allFinite(), "start.spin", "finite");
}

SurfaceDistance surface_distance(const Plane& plane, const Vec3& point) {
  return {plane.normal.dot(point) - plane.offset, plane.normal};
}

SurfaceDistance surface_distance(const SolidBox& box, const Vec3& point) {
  const Vec3 local = box.local(point);
  const Vec3 beyond = local.cwiseAbs() - box.half_size;
  Vec3 normal = Vec3::Zero();
  if (beyond.maxCoeff() > 0) {  // outside: towards the point from the nearest one of the surface
    const Vec3 nearest = local.cwiseMax(-box.half_size).cwiseMin(box.half_size);
    normal = local - nearest;
    const double distance = normal.norm();
    return {distance, box.rotation * (normal / distance)};
  }
  Eigen::Index axis = 0;
  const double distance = beyond.maxCoeff(&axis);
  normal[axis] = local[axis] < 0 ? -1 : 1;
  return {distance, box.rotation * normal};
}

}  // namespace

void validate(const Scenario& scenario) {
  require(scenario.gravity.allFinite(), "gravity", "finite");
  require(std::isfinite(scenario.duration) && scenario.duration > 0, "duration",
          "a finite number of seconds above 0");
  validate(scenario.start);
  for (std::size_t i = 0; i < scenario.obstacles.size(); ++i)
    validate(scenario.obstacles[i], fmt::format("obstacles[{}]", script_number(i)));
  if (scenario.stop) {
    require(std::isfinite(scenario.stop->speed) && scenario.stop->speed > 0, "stop.speed",
            "a finite number of m/s above 0");
    require(std::isfinite(scenario.stop->hold) && scenario.stop->hold >= 0, "stop.hold",
            "a finite number of seconds, 0 or more");
  }
  const bool known =
      scenario.measure_from.empty() ||
      std::any_of(scenario.obstacles.begin(), scenario.obstacles.end(),
                  [&](const Obstacle& o) { return o.name == scenario.measure_from; });
  if (!known)
    throw InputError(fmt::format(
        "scenario: measure_from = \"{}\" must be the name of an obstacle, or empty to measure the "
        "horizontal displacement",
        scenario.measure_from));
}

State initial_state(const MassSpringModel& model, const Throw& start) {
  validate(start);
  const Vec3 center = mass_properties(model).center;
  // Computed as displacements of the rest positions, so that a body that is not moved keeps its
  // positions bit by bit.
  const Vec3 shift = start.placed ? Vec3(start.position - center) : Vec3(Vec3::Zero());
  const Mat3 turn = start.rotation - Mat3::Identity();
  State state = rest_state(model);
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const Vec3 arm = model.rest[i] - center;
    state.x[i] += shift + turn * arm;
    state.v[i] = start.velocity + start.spin.cross(start.rotation * arm);
  }
  return state;
}

SurfaceDistance surface_distance(const Obstacle& obstacle, const Vec3& point) {
  return std::visit([&](const auto& shape) { return surface_distance(shape, point); },
                    obstacle.shape);
}

}  // namespace springlod::sim
