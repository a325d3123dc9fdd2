#include "sim/crossing_watch.hpp"

#include <utility>

#include "sim/motion.hpp"

namespace springlod {

std::optional<Crossing> CrossingWatch::look(State state) {
  const Vec3 spin = angular_velocity(*model_, before_);
  const double angle = spin.norm() * (state.t - before_.t);
  const Mat3 turn = angle > 0 ? Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix()
                              : Mat3(Mat3::Identity());
  std::optional<Crossing> crossing;
  for (std::uint32_t s = 0; s < model_->spring_count() && !crossing; ++s) {
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    const Vec3 before = turn * (before_.x[b] - before_.x[a]);
    if (before.dot(state.x[b] - state.x[a]) < 0) crossing = Crossing{a, b, state.t};
  }
  before_ = std::move(state);
  return crossing;
}

}  // namespace springlod
