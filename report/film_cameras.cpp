#include "report/film_cameras.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <variant>

#include "render/overlay.hpp"
#include "report/playback.hpp"

namespace springlod::report {
namespace {

/// Largest extent of the surface beyond the nodes at rest [m].
double surface_margin(const FilmedRun& run) {
  if (run.surface == nullptr) return 0;
  const Box3 nodes = bounds(run.body.rest);
  const Box3 surface = bounds(*run.surface);
  return std::max(
      {0., (nodes.min() - surface.min()).maxCoeff(), (surface.max() - nodes.max()).maxCoeff()});
}

/// Bounds of the bodies in motion.
Box3 motion_bounds(std::span<const FilmedRun> runs, const std::vector<double>& times) {
  Box3 box;
  double beyond = 0;
  for (const FilmedRun& run : runs) {
    for (const double t : times) box.extend(bounds(positions_at(run.body_frames, t)));
    beyond = std::max(beyond, surface_margin(run));
  }
  const Vec3 margin = Vec3::Constant(beyond);
  box.min() -= margin;
  box.max() += margin;
  return box;
}

/// Bounds of the whole motion, with the floor below it and nearby walls and boxes.
Box3 action_bounds(std::span<const FilmedRun> runs, const std::vector<double>& times) {
  const Box3 action = motion_bounds(runs, times);
  constexpr double kNear = 0.5;  // fraction of the size of the motion
  const double near = kNear * action.diagonal().norm();
  Box3 box = action;
  const auto extend = [&](const sim::Obstacle& obstacle) {
    if (const auto* plane = std::get_if<sim::Plane>(&obstacle.shape)) {
      const double height = plane->normal.dot(action.center()) - plane->offset;
      const Vec3 foot = action.center() - height * plane->normal;
      if (action.exteriorDistance(foot) <= near) box.extend(foot);
    } else if (const auto* solid = std::get_if<sim::SolidBox>(&obstacle.shape)) {
      Box3 around;
      for (int i = 0; i < 8; ++i) {
        const Vec3 sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
        around.extend(solid->center + solid->rotation * sign.cwiseProduct(solid->half_size));
      }
      // Only the near part of a large box, such as a slab used as floor.
      const Box3 seen(action.min() - Vec3::Constant(near), action.max() + Vec3::Constant(near));
      const Box3 part = around.intersection(seen);
      if (!part.isEmpty()) box.extend(part);
    }
  };
  for (const FilmedRun& run : runs)
    for (const sim::Obstacle& obstacle : run.scenario.obstacles) extend(obstacle);
  return box;
}

double facing(const sim::Obstacle& obstacle, double azimuth) {
  const auto* plane = std::get_if<sim::Plane>(&obstacle.shape);
  if (plane == nullptr) return 1;
  const Vec3 across(plane->normal.x(), plane->normal.y(), 0);
  constexpr double kWall = 0.7;  // cosine; floors and ramps never hide the motion
  if (across.norm() < kWall * plane->normal.norm()) return 1;
  const double angle = azimuth * std::numbers::pi / 180;
  return across.normalized().dot(Vec3(std::cos(angle), std::sin(angle), 0));
}

/// The azimuth, or one of its mirror images, from which no wall hides the motion.
double azimuth_of(const std::vector<FilmedRun>& runs, const AnimateOptions& options) {
  if (!options.avoid_walls) return options.azimuth;
  const double az = options.azimuth;
  double best = az;
  double best_facing = -2;
  for (const double candidate : {az, -180 - az, -az, 180 + az}) {
    double worst = 1;
    for (const FilmedRun& run : runs)
      for (const sim::Obstacle& obstacle : run.scenario.obstacles)
        worst = std::min(worst, facing(obstacle, candidate));
    constexpr double kEnough = 0.15;  // cosine; excludes views along the wall
    if (worst >= kEnough) return candidate;
    if (worst > best_facing) {
      best_facing = worst;
      best = candidate;
    }
  }
  return best;
}

/// The part of a panel that labels leave to the body.
render::LabelRoom room_for_labels(const std::vector<FilmedRun>& runs,
                                  const AnimateOptions& options) {
  const int height = static_cast<int>(options.height);
  std::size_t captions = 0;
  for (const FilmedRun& run : runs) captions = std::max(captions, run.captions.size());
  const render::DrawStyle& style = options.style;
  const bool strain = style.springs && style.spring_colour == render::SpringColour::strain;
  const bool values = style.node_colour != render::NodeColour::material;
  const double scales = ((strain ? 1 : 0) + (values ? 1 : 0)) * render::scale_share(height);
  return render::room_beside_labels(render::heading_share(height, captions),
                                    std::max(render::footer_share(height), scales));
}

render::Framing framing_of(const std::vector<FilmedRun>& runs, const AnimateOptions& options) {
  constexpr double kFieldOfView = 35;  // [degrees]
  constexpr double kMargin = 0.08;
  const render::LabelRoom room = room_for_labels(runs, options);
  return {.azimuth = azimuth_of(runs, options),
          .elevation = options.elevation,
          .aspect = static_cast<double>(options.width) / options.height,
          .fov_degrees = kFieldOfView,
          .headroom = room.above,
          .footroom = room.below,
          .margin = kMargin};
}

/// Points whose hull is nearly the ball: the directions to corners, edges and faces of a cube.
std::vector<Vec3> points_of_ball(const Vec3& center, double radius) {
  std::vector<Vec3> points;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0)
          points.emplace_back(center + radius * Vec3(x, y, z).normalized());
  return points;
}

std::vector<Vec3> corners(const Box3& box) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.push_back(box.corner(static_cast<Box3::CornerType>(i)));
  return points;
}

/// A camera that keeps the body of the run in the middle, one per frame.
std::vector<render::Camera> following_cameras(const FilmedRun& run,
                                              const std::vector<double>& times,
                                              const render::Framing& framing,
                                              const AnimateOptions& options) {
  std::vector<Vec3> path;
  for (const double t : times)
    path.push_back(center_of_mass(run.body, positions_at(run.body_frames, t)));
  constexpr double kSmooth = 0.12;  // to both sides [s of the video]
  const std::vector<Vec3> centers = path;
  // Three box filters are close to a Gaussian one: no kink where the body bounces.
  for (int pass = 0; pass < 3; ++pass)
    path = smoothed(
        path, static_cast<std::uint32_t>(kSmooth * options.frame_rate.value_or(kUsualFrameRate)));
  // A ball that contains the body in every orientation, and stretched by an impact.
  const Vec3 center = center_of_mass(run.body, run.body.rest);
  double radius = 0;
  for (const Vec3& p : run.body.rest) radius = std::max(radius, (p - center).norm());
  double behind = 0;  // largest distance of the body from the middle of the view
  for (std::size_t k = 0; k < path.size(); ++k)
    behind = std::max(behind, (path[k] - centers[k]).norm());
  constexpr double kStretch = 1.15;
  radius = std::max(kStretch * (radius + surface_margin(run)), radius + behind);
  std::vector<render::Camera> cameras;
  for (const Vec3& p : path)
    cameras.push_back(render::frame_points(points_of_ball(p, radius), framing));
  return cameras;
}

bool bodies_differ_in_size(const std::vector<FilmedRun>& runs) {
  std::vector<double> sizes;
  for (const FilmedRun& run : runs) {
    const Box3 box = run.surface != nullptr ? bounds(*run.surface) : bounds(run.body.rest);
    sizes.push_back(box.diagonal().norm());
  }
  return differ_in_size(sizes);
}

}  // namespace

bool differ_in_size(const std::vector<double>& sizes) {
  constexpr double kAlike = 1.5;  // levels of one chain, and a body before and after it deforms
  if (sizes.empty()) return false;
  const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
  return *most > kAlike * *least;
}

std::vector<std::vector<render::Camera>> film_cameras(const std::vector<FilmedRun>& runs,
                                                      const std::vector<double>& times,
                                                      const AnimateOptions& options) {
  const render::Framing framing = framing_of(runs, options);
  std::vector<std::vector<render::Camera>> cameras;
  if (options.camera == CameraMode::follow) {
    for (const FilmedRun& run : runs)
      cameras.push_back(following_cameras(run, times, framing, options));
    return cameras;
  }
  const auto fixed = [&](std::span<const FilmedRun> seen) {
    return std::vector<render::Camera>(
        times.size(), render::frame_points(corners(action_bounds(seen, times)), framing));
  };
  if (!bodies_differ_in_size(runs)) {
    cameras.assign(runs.size(), fixed(runs));
    return cameras;
  }
  for (const FilmedRun& run : runs) cameras.push_back(fixed({&run, 1}));
  return cameras;
}

}  // namespace springlod::report
