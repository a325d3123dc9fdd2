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

}  // namespace

StepController::StepController(const MassSpringModel& model, const StepLimit& limit, double step)
    : model_(&model), limit_(limit), step_(step) {}

// The frequency bounds of the nodes exceed the highest frequency, those of light nodes by far.
// Therefore only the relative growth of each bound is used.
double StepController::frequency(const std::vector<Vec3>& x) {
  if (at_rest_.empty()) at_rest_ = elastic::node_frequency_bounds(*model_, model_->rest);
  const std::vector<double> now = elastic::node_frequency_bounds(*model_, x);
  const double square = limit_.omega * limit_.omega;
  double most = square;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (at_rest_[i] > 0) most = std::max(most, std::min(now[i], square * now[i] / at_rest_[i]));
  return std::sqrt(most);
}

double StepController::step_for(const std::vector<Vec3>& x, double strain) {
  const double omega = strain > kSmallStrain ? frequency(x) : limit_.omega;
  const double limit = elastic::stable_step(omega, limit_.damping_time);
  const auto step = [&] { return std::ldexp(step_, -static_cast<int>(halvings_)); };
  while (halvings_ < kMostHalvings && step() > kTooLong * limit) ++halvings_;
  while (halvings_ > 0 && 2 * step() < kShortEnough * limit) --halvings_;
  return step();
}

}  // namespace springlod::sim
