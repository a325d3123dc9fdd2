#include "sim/study/probe.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "sim/run/motion.hpp"

namespace springlod::sim {
namespace {

// Amplitude of the ends in the slowest mode, as a fraction of the longest side [1].
constexpr double kSwing = 0.01;

// Total angle of rotation of the body [rad]: it moves the ends by about that amplitude.
constexpr double kTurn = 0.05;

// Mean square of the coordinate along the body in [-1, 1]; subtracted so that bending does not move
// the centre of mass.
constexpr double kMeanSquare = 1. / 3;

/// From 0 at the anchored nodes to 1 at the distance `reach` from them, without a kink [1].
double part_of_speed(const MassSpringModel& model, const std::vector<std::uint32_t>& anchored,
                     std::uint32_t node, double reach) {
  double nearest = reach * reach;
  for (const std::uint32_t other : anchored)
    nearest = std::min(nearest, (model.rest[node] - model.rest[other]).squaredNorm());
  const double part = std::sqrt(nearest) / reach;
  return part * part * (3 - 2 * part);
}

}  // namespace

ProbeMotion probe_motion(const MassSpringModel& base, double omega, double duration) {
  const Vec3 size = bounds(base.rest).sizes();
  std::array<Eigen::Index, 3> axes{0, 1, 2};
  for (int pass = 0; pass < 2;
       ++pass)  // three sides, the longest first; equal ones keep their order
    for (std::size_t i = 0; i < 2; ++i)
      if (size[axes[i + 1]] > size[axes[i]]) std::swap(axes[i], axes[i + 1]);
  ProbeMotion motion;
  motion.center = mass_properties(base).center;
  motion.along = Vec3::Unit(axes[0]);
  motion.across = Vec3::Unit(axes[1]);
  motion.half_length = size[axes[0]] / 2;
  motion.speed = kSwing * size[axes[0]] * omega;
  motion.spin = kTurn / duration * Vec3::Ones().normalized();
  motion.duration = duration;
  return motion;
}

State probe_state(const MassSpringModel& model, const ProbeMotion& motion,
                  const std::vector<std::uint32_t>& anchored) {
  State state = rest_state(model);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const double place = motion.along.dot(model.rest[i] - motion.center) / motion.half_length;
    state.v[i] =
        motion.speed * (place * motion.along + (place * place - kMeanSquare) * motion.across);
  }
  if (!anchored.empty()) {
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      state.v[i] *= part_of_speed(model, anchored, i, motion.half_length);
    return state;
  }
  const Vec3 drift = center_of_mass(model, state.v);
  for (Vec3& v : state.v) v -= drift;
  // Removes the rotation due to stretching and bending, so that only the spin remains.
  const Vec3 center = mass_properties(model).center;
  const Vec3 turn = motion.spin - angular_velocity(model, state);
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    state.v[i] += turn.cross(model.rest[i] - center);
  return state;
}

}  // namespace springlod::sim
