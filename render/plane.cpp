#include "render/plane.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::render {
namespace {

// Half size of a patch in view radii; the plane has faded out at this distance.
constexpr double kReach = 4.5;
// The shader draws every fifth line stronger, so the grid repeats after 5 spacings.
constexpr double kGridPeriod = 5;

}  // namespace

double grid_spacing(double view_radius) {
  // 1 m for views of 2 to 20 m, so that 2 to 20 lines cross the image.
  return std::pow(10., std::floor(std::log10(std::max(view_radius, 1e-9))));
}

PlanePatch plane_patch(const DrawnPlane& plane, const Camera& camera, double aspect) {
  if (!plane.normal.allFinite() || !(plane.normal.norm() > 0) || !std::isfinite(plane.offset))
    throw InputError(fmt::format(
        "drawing: a plane's normal ({}, {}, {}) must be finite and not zero, its offset finite",
        plane.normal.x(), plane.normal.y(), plane.normal.z()));
  const double length = plane.normal.norm();
  const Vec3 normal = plane.normal / length;
  const double offset = plane.offset / length;
  const Vec3 world_up = camera.up.normalized();
  PlanePatch patch;
  constexpr double kWall = 0.7;  // cosine of the angle: steeper than 45 deg
  patch.upright = std::abs(normal.dot(world_up)) < kWall;
  Vec3 v = world_up - world_up.dot(normal) * normal;
  if (!patch.upright) {
    const Vec3 y = Vec3::UnitY() - normal.y() * normal;
    const Vec3 x = Vec3::UnitX() - normal.x() * normal;
    v = y.norm() > 0.1 ? y : x;
  }
  v.normalize();
  const Vec3 u = v.cross(normal);
  const double height = normal.dot(camera.target) - offset;
  const Vec3 foot = camera.target - height * normal;
  const double period = kGridPeriod * grid_spacing(view_radius(camera));
  patch.normal = normal.cast<float>();
  patch.offset = static_cast<float>(-height);
  patch.center = (-height * normal).cast<float>();
  patch.u = u.cast<float>();
  patch.v = v.cast<float>();
  patch.reach = static_cast<float>(kReach * view_radius(camera) * std::max(1., aspect));
  patch.grid_origin =
      Eigen::Vector2d(std::remainder(foot.dot(u), period), std::remainder(foot.dot(v), period))
          .cast<float>();
  patch.seen_from_behind = normal.dot(camera.eye) < offset;
  return patch;
}

}  // namespace springlod::render
