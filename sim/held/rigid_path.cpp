#include "sim/held/rigid_path.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace springlod::sim {
namespace {

/// Slope between two secants of lengths h and slopes d: their weighted harmonic mean, 0 at a
/// turning point. Monotone between the poses (Fritsch and Butland 1984).
double slope_between(double h_before, double d_before, double h_after, double d_after) {
  if (!(d_before * d_after > 0)) return 0;
  const double a = 2 * h_after + h_before;
  const double b = h_after + 2 * h_before;
  return (a + b) / (a / d_before + b / d_after);
}

Mat3 cross_matrix(const Vec3& v) {
  return (Mat3() << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0).finished();
}

Mat3 rotation_of(const Vec3& turn) {
  const double angle = turn.norm();
  if (!(angle > 0)) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
}

/// The angular velocity of a rotation whose rotation vector changes at `rate` [rad/s]: the left
/// Jacobian of the exponential map.
Vec3 spin_of(const Vec3& turn, const Vec3& rate) {
  constexpr double kSmall = 1e-4;  // below it the series to second order is exact to rounding [rad]
  const double angle = turn.norm();
  const double first =
      angle < kSmall ? 0.5 - angle * angle / 24 : (1 - std::cos(angle)) / (angle * angle);
  const double second = angle < kSmall ? 1. / 6 - angle * angle / 120
                                       : (angle - std::sin(angle)) / (angle * angle * angle);
  const Mat3 cross = cross_matrix(turn);
  return rate + first * (cross * rate) + second * (cross * (cross * rate));
}

}  // namespace

RigidPath::RigidPath(const std::vector<AnchorKey>& keys) {
  if (keys.empty()) return;
  time_.push_back(0);
  value_.push_back({});
  for (const AnchorKey& key : keys) {
    time_.push_back(key.time);
    value_.push_back(
        {key.move.x(), key.move.y(), key.move.z(), key.turn.x(), key.turn.y(), key.turn.z()});
  }
  slope_.assign(time_.size(), {});
  for (std::size_t k = 1; k + 1 < time_.size(); ++k)
    for (std::size_t c = 0; c < slope_[k].size(); ++c) {
      const double before = time_[k] - time_[k - 1];
      const double after = time_[k + 1] - time_[k];
      slope_[k][c] = slope_between(before, (value_[k][c] - value_[k - 1][c]) / before, after,
                                   (value_[k + 1][c] - value_[k][c]) / after);
    }
}

RigidPath::Pose RigidPath::at(double time) const {
  if (time_.empty() || !(time > 0)) return {};
  const double now = std::min(time, time_.back());
  const std::size_t end = std::min<std::size_t>(
      static_cast<std::size_t>(std::upper_bound(time_.begin(), time_.end(), now) - time_.begin()),
      time_.size() - 1);
  const std::size_t begin = end - 1;
  const double length = time_[end] - time_[begin];
  const double s = (now - time_[begin]) / length;
  Components value;
  Components rate;
  for (std::size_t c = 0; c < value.size(); ++c) {
    const double from = value_[begin][c];
    const double step = value_[end][c] - from;
    const double first = length * slope_[begin][c];
    const double last = length * slope_[end][c];
    // Hermite's cubic.
    const double square = 3 * step - 2 * first - last;
    const double cube = first + last - 2 * step;
    value[c] = from + s * (first + s * (square + s * cube));
    rate[c] = (first + s * (2 * square + s * 3 * cube)) / length;
  }
  const Vec3 turn(value[3], value[4], value[5]);
  Pose pose{.move = {value[0], value[1], value[2]}, .rotation = rotation_of(turn)};
  if (time > now) return pose;
  pose.velocity = {rate[0], rate[1], rate[2]};
  pose.spin = spin_of(turn, {rate[3], rate[4], rate[5]});
  return pose;
}

}  // namespace springlod::sim
