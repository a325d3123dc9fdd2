#include "render/plane.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::render {
namespace {

// Half size of a patch in view radii; the plane has faded out at this distance.
constexpr double kReach = 4.5;
// Every fifth line is stronger, and arrows are 1, 2 or 5 spacings apart: both repeat after 10.
constexpr double kGridPeriod = 10;

}  // namespace

double grid_spacing(double view_radius) {
  // 1 m for views of 2 to 20 m, so that 2 to 20 lines cross the image.
  return std::pow(10., std::floor(std::log10(std::max(view_radius, 1e-9))));
}

double arrow_spacing(double view_radius) {
  const double spacing = grid_spacing(view_radius);
  const double lines = view_radius / spacing;  // 1 to 10
  return spacing * (lines < 3 ? 1 : lines < 6 ? 2 : 5);
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
  // Cosines of the angle to the vertical: planes of less than 3 deg are floors, of more than 70 deg
  // walls.
  constexpr double kFloor = 0.9986;
  constexpr double kWall = 0.342;
  const double level = std::abs(normal.dot(world_up));
  patch.kind = level > kFloor  ? PlanePatch::Kind::floor
               : level < kWall ? PlanePatch::Kind::wall
                               : PlanePatch::Kind::ramp;
  Vec3 v = world_up - world_up.dot(normal) * normal;
  if (patch.kind == PlanePatch::Kind::floor) {
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

std::vector<Vec3f> clipped(const std::vector<Vec3f>& polygon, const Vec3f& normal, float offset) {
  std::vector<Vec3f> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3f& a = polygon[i];
    const Vec3f& b = polygon[(i + 1) % polygon.size()];
    const float height_a = normal.dot(a) - offset;
    const float height_b = normal.dot(b) - offset;
    if (height_a >= 0) kept.push_back(a);
    if ((height_a >= 0) != (height_b >= 0))
      kept.emplace_back(a + (b - a) * (height_a / (height_a - height_b)));
  }
  return kept;
}

std::vector<Vec3f> visible_polygon(const std::vector<PlanePatch>& patches, std::size_t which) {
  const PlanePatch& patch = patches[which];
  const Vec3f u = patch.reach * patch.u;
  const Vec3f v = patch.reach * patch.v;
  std::vector<Vec3f> polygon{patch.center - u - v, patch.center + u - v, patch.center + u + v,
                             patch.center - u + v};
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (i != which) polygon = clipped(polygon, patches[i].normal, patches[i].offset);
  return polygon;
}

std::vector<Vec3f> shaded_part(std::vector<Vec3f> polygon, const Mat4f& to_unit_cube) {
  constexpr float kBeyond = 0.12F;  // of the side of the shadow map
  for (int axis = 0; axis < 2; ++axis) {
    const Vec3f row = to_unit_cube.block<1, 3>(axis, 0).transpose();
    polygon = clipped(polygon, row, -kBeyond - to_unit_cube(axis, 3));
    polygon = clipped(polygon, -row, to_unit_cube(axis, 3) - 1 - kBeyond);
  }
  return polygon;
}

std::vector<SpringInstance> plane_edges(const std::vector<PlanePatch>& patches, std::size_t which,
                                        float radius) {
  constexpr int kPieces = 24;  // of an edge, so that its colour follows the fading plane
  constexpr Colour kEdge{0.60F, 0.63F, 0.67F};
  constexpr Colour kFaded{0.93F, 0.94F, 0.95F};
  const PlanePatch& patch = patches[which];
  const auto colour = [&](const Vec3f& p) {
    const float away = (p - patch.center).norm() / patch.reach;
    const float t = std::clamp(away / 0.6F, 0.F, 1.F);
    return Colour{kEdge.r + t * (kFaded.r - kEdge.r), kEdge.g + t * (kFaded.g - kEdge.g),
                  kEdge.b + t * (kFaded.b - kEdge.b)};
  };
  const float slack = 1e-4F * patch.reach;
  const std::vector<Vec3f> polygon = visible_polygon(patches, which);
  std::vector<SpringInstance> edges;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3f& a = polygon[k];
    const Vec3f b = polygon[(k + 1) % polygon.size()];
    const bool shared = std::any_of(patches.begin(), patches.end(), [&](const PlanePatch& other) {
      return &other != &patch && std::abs(other.normal.dot(a) - other.offset) < slack &&
             std::abs(other.normal.dot(b) - other.offset) < slack;
    });
    for (int piece = 0; shared && piece < kPieces; ++piece) {
      const Vec3f from = a + (b - a) * (static_cast<float>(piece) / kPieces);
      const Vec3f to = a + (b - a) * (static_cast<float>(piece + 1) / kPieces);
      if (std::min((from - patch.center).norm(), (to - patch.center).norm()) < 0.6F * patch.reach)
        edges.push_back({from, to, colour(from), colour(to), radius});
    }
  }
  return edges;
}

}  // namespace springlod::render
