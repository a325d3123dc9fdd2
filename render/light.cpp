#include "render/light.hpp"

#include <algorithm>

namespace springlod::render {
namespace {

// Light from the upper left front: shadows fall to the right, inside the view, and are short enough
// to stay near the body.
constexpr double kAbove = 1.25;
constexpr double kLeft = 0.55;
constexpr double kFront = 0.35;
// Margin around the casters for soft edges, as a fraction of the map's side; the widest penumbra of
// the plane shader is 0.06.
constexpr double kSoftMargin = 0.14;

}  // namespace

KeyLight key_light(const Camera& camera, const Box3& casters) {
  const CameraAxes axes = camera_axes(camera);
  const Vec3 up = camera.up.normalized();
  Vec3 front = axes.back - up.dot(axes.back) * up;
  constexpr double kStraightDown = 1e-6;
  if (front.norm() < kStraightDown) front = -axes.up;
  const Vec3 direction =
      (kAbove * up - kLeft * axes.right + kFront * front.normalized()).normalized();
  KeyLight light;
  light.direction = direction.cast<float>();
  if (casters.isEmpty()) return light;

  Mat3 to_light;  // rows: two axes perpendicular to the rays, one opposite to them
  to_light.row(0) = axes.right.cross(direction).normalized();
  to_light.row(1) = direction.cross(to_light.row(0).transpose());
  to_light.row(2) = direction;
  Box3 box;
  for (int i = 0; i < 8; ++i)
    box.extend(to_light * casters.corner(static_cast<Box3::CornerType>(i)));
  const double widest = std::max(box.sizes().x(), box.sizes().y());
  const double side = std::max(widest / (1 - kSoftMargin), 1e-9);
  const double depth = std::max(box.sizes().z() * 1.02, side * 1e-3);
  const Vec3 center = box.center();
  Eigen::Matrix4d projection = Eigen::Matrix4d::Identity();
  projection.block<1, 3>(0, 0) = to_light.row(0) * 2 / side;
  projection.block<1, 3>(1, 0) = to_light.row(1) * 2 / side;
  projection.block<1, 3>(2, 0) = -to_light.row(2) * 2 / depth;
  projection(0, 3) = -center.x() * 2 / side;
  projection(1, 3) = -center.y() * 2 / side;
  projection(2, 3) = center.z() * 2 / depth;
  Eigen::Matrix4d to_unit = Eigen::Matrix4d::Identity();
  to_unit.topLeftCorner<3, 3>() *= 0.5;
  to_unit.topRightCorner<3, 1>().setConstant(0.5);
  light.projection = projection.cast<float>();
  light.to_unit_cube = (to_unit * projection).cast<float>();
  light.side = static_cast<float>(side);
  light.depth = static_cast<float>(depth);
  return light;
}

}  // namespace springlod::render
