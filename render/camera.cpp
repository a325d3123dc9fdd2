#include "render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"

namespace springlod::render {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// Near and far plane as multiples of the distance from eye to target.
constexpr double kNear = 0.02;
constexpr double kFar = 50;
// Margin around the framed box, as a fraction of it; larger above and below, for labels.
constexpr double kMarginAcross = 0.06;
constexpr double kMarginOfBox = 0.22;
// Largest aspect of panels whose vertical field of view is used as given.
constexpr double kUsualAspect = 4. / 3;

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  const Vec3 back = (camera.eye - camera.target).normalized();
  Vec3 right = camera.up.cross(back);
  constexpr double kParallel = 1e-6;
  if (right.norm() < kParallel) right = Vec3::UnitY().cross(back);
  if (right.norm() < kParallel) right = Vec3::UnitX().cross(back);
  right.normalize();
  return {right, back.cross(right), back};
}

double view_radius(const Camera& camera) {
  return (camera.eye - camera.target).norm() * std::tan(camera.fov_degrees * kDegree / 2);
}

Mat4f view_projection(const Camera& camera, double aspect) {
  const CameraAxes axes = camera_axes(camera);
  const double distance = (camera.eye - camera.target).norm();
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = axes.right.transpose();
  view.block<1, 3>(1, 0) = axes.up.transpose();
  view.block<1, 3>(2, 0) = axes.back.transpose();
  view(2, 3) = -distance;
  const double near = kNear * distance;
  const double far = kFar * distance;
  const double cot = 1 / std::tan(camera.fov_degrees * kDegree / 2);
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = cot / aspect;
  projection(1, 1) = cot;
  projection(2, 2) = -(far + near) / (far - near);
  projection(2, 3) = -2 * far * near / (far - near);
  projection(3, 2) = -1;
  return (projection * view).cast<float>();
}

namespace {

std::vector<Vec3> corners(const Box3& box) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<Box3::CornerType>(i)));
  return points;
}

// Least distance for which an eye at `target + distance * back` sees all points.
double fitting_distance(const std::vector<Vec3>& points, const Vec3& target, const CameraAxes& axes,
                        double tan_x, double tan_y) {
  double distance = 0;
  for (const Vec3& p : points) {
    const Vec3 r = p - target;
    const double toward = r.dot(axes.back);
    distance = std::max({distance, toward + std::abs(r.dot(axes.right)) / tan_x,
                         toward + std::abs(r.dot(axes.up)) / tan_y});
  }
  return distance;
}

double field_of_view(const Framing& framing) {
  if (framing.aspect <= kUsualAspect) return framing.fov_degrees;
  const double tan_half = std::tan(framing.fov_degrees * kDegree / 2);
  return 2 * std::atan(tan_half * kUsualAspect / framing.aspect) / kDegree;
}

}  // namespace

Camera frame_box(const Box3& box, double azimuth, double elevation, double aspect,
                 double fov_degrees) {
  return frame_points(box.isEmpty() ? std::vector<Vec3>{} : corners(box),
                      {.azimuth = azimuth,
                       .elevation = elevation,
                       .aspect = aspect,
                       .fov_degrees = fov_degrees,
                       .margin = kMarginOfBox});
}

Camera frame_points(const std::vector<Vec3>& points, const Framing& framing) {
  const Box3 box = bounds(points);
  if (box.isEmpty() || !box.sizes().allFinite())
    throw InputError("camera: there are no points to frame, or a point is not finite");
  if (!(framing.aspect > 0) || !(framing.fov_degrees > 0 && framing.fov_degrees < 180))
    throw InputError("camera: the aspect must be above 0, the field of view between 0 and 180 deg");
  if (!(framing.margin >= 0)) throw InputError("camera: the margin must be 0 or more");
  if (!(framing.headroom >= 0 && framing.footroom >= 0 && framing.headroom + framing.footroom < 1))
    throw InputError("camera: headroom and footroom must be 0 or more and together below 1");
  const double az = framing.azimuth * kDegree;
  const double el = framing.elevation * kDegree;
  const Vec3 back(std::cos(az) * std::cos(el), std::sin(az) * std::cos(el), std::sin(el));
  Camera camera;
  camera.fov_degrees = field_of_view(framing);
  camera.target = box.center();
  camera.eye = camera.target + back;
  const CameraAxes axes = camera_axes(camera);
  const double tan_half = std::tan(camera.fov_degrees * kDegree / 2);
  const double tan_y = (1 - framing.headroom - framing.footroom) * tan_half / (1 + framing.margin);
  const double tan_x = tan_half * framing.aspect / (1 + kMarginAcross);
  // Perspective enlarges the near side: shift the target until the margins at opposite sides are
  // equal. Eight iterations converge to well below a pixel.
  double distance = fitting_distance(points, camera.target, axes, tan_x, tan_y);
  for (int round = 0; round < 8; ++round) {
    double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
    for (const Vec3& p : points) {
      const Vec3 r = p - camera.target;
      const double depth = distance - r.dot(axes.back);
      left = std::min(left, r.dot(axes.right) / depth);
      right = std::max(right, r.dot(axes.right) / depth);
      low = std::min(low, r.dot(axes.up) / depth);
      high = std::max(high, r.dot(axes.up) / depth);
    }
    camera.target += distance * ((left + right) / 2 * axes.right + (low + high) / 2 * axes.up);
    distance = fitting_distance(points, camera.target, axes, tan_x, tan_y);
  }
  constexpr double kLeast = 1e-9;  // allows boxes of one point
  distance = std::max(distance, kLeast);
  camera.target += (framing.headroom - framing.footroom) * tan_half * distance * axes.up;
  camera.eye = camera.target + distance * back;
  return camera;
}

}  // namespace springlod::render
