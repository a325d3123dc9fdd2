#include "sim/run/step_watch.hpp"

#include <algorithm>
#include <cmath>

#include "elastic/stable_step.hpp"

namespace springlod::sim {
namespace {

// A step is halved if it exceeds the first fraction of the limit, and doubled if twice the step is
// below the second. The fractions differ enough to prevent alternation [1].
constexpr double kTooLong = 0.95;
constexpr double kShortEnough = 0.85;

constexpr std::uint32_t kMostHalvings = 6;  // a body that needs more has diverged

// The same for corners alone, which are stable with any step: a shorter step only follows them more
// exactly. [1]
constexpr std::uint32_t kMostByCorners = 1;

// Steps after the last strain before the step is doubled for the first time [steps]: a few periods
// of the slowest vibration of a body of 50 cells.
constexpr std::uint64_t kCalm = 512;

}  // namespace

StepController::StepController(const MassSpringModel& model, const StepLimit& limit, double step)
    : model_(&model), limit_(limit), step_(step), calm_(kCalm) {}

// The frequency bounds of the nodes exceed the highest frequency, those of light nodes by far.
// Therefore only the relative growth of each bound is used.
double StepController::frequency(const std::vector<Vec3>& x) {
  if (at_rest_.empty()) at_rest_ = elastic::node_frequency_bounds(*model_, model_->rest);
  const std::vector<double> now = elastic::strained_frequency_bounds(*model_, x, kSmallStrain);
  const double square = limit_.omega * limit_.omega;
  double most = square;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (at_rest_[i] > 0) most = std::max(most, std::min(now[i], square * now[i] / at_rest_[i]));
  return std::sqrt(most);
}

bool StepController::corners_may_halve() const {
  return halvings_ < kMostByCorners;
}

// Halving and doubling in time with a vibration would feed energy into it (parametric resonance):
// the step grows late, and later every time.
double StepController::step_for(const std::vector<Vec3>& x, const Strained& found) {
  const double omega = found.strain > kSmallStrain ? frequency(x) : limit_.omega;
  const double limit = elastic::stable_step(omega, limit_.damping_time);
  const auto step = [&] { return std::ldexp(step_, -static_cast<int>(halvings_)); };
  const bool turning = found.corner_change > kCornerChange;
  const bool short_enough =
      2 * step() < kShortEnough * limit && found.corner_change < kCornerChange / 2;
  if (turning && corners_may_halve()) ++halvings_;
  while (halvings_ < kMostHalvings && step() > kTooLong * limit) ++halvings_;
  if (!short_enough) last_short_ = found.step_number;
  if (halvings_ > 0 && found.step_number - last_short_ >= calm_) {
    --halvings_;
    calm_ *= 2;
    last_short_ = found.step_number;
  }
  return step();
}

}  // namespace springlod::sim
