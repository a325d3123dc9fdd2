#include "sim/run/spring_watch.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/run/motion.hpp"

namespace springlod::sim {

Mat3 SpringCheck::rotation_until(double time) const {
  const Vec3 spin = angular_velocity(*model_, before_);
  const double angle = spin.norm() * (time - before_.t);
  return angle > 0 ? Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix()
                   : Mat3(Mat3::Identity());
}

void SpringCheck::check(State state) {
  bool crossed = first_crossing_.has_value() || !model_->corners.empty();
  const Mat3 turn = crossed ? Mat3(Mat3::Identity()) : rotation_until(state.t);
  double most = 1;  // largest l^2 / L^2
  double least = 1;
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    const Vec3 now = state.x[b] - state.x[a];
    const double square = now.squaredNorm() / (model_->rest_length[s] * model_->rest_length[s]);
    most = std::max(most, square);
    least = std::min(least, square);
    if (crossed) continue;
    crossed = (turn * (before_.x[b] - before_.x[a])).dot(now) < 0;
    if (crossed) first_crossing_ = Crossing{a, b, state.t};
  }
  largest_strain_ = std::max(std::sqrt(most) - 1, 1 - std::sqrt(least));
  before_ = std::move(state);
}

}  // namespace springlod::sim
