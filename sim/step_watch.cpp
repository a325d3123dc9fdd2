#include "sim/step_watch.hpp"

#include <algorithm>
#include <cmath>

#include "model/stable_step.hpp"

namespace springlod {
namespace {

// A step is halved above this part of the limit, and doubled if twice of it is below the other; far
// enough apart that it does not go back and forth [1].
constexpr double kTooLong = 0.95;
constexpr double kShortEnough = 0.85;

constexpr std::uint32_t kMostHalvings = 6;  // a body that needs more is past saving

}  // namespace

StepWatch::StepWatch(const MassSpringModel& model, const StepLimit& limit, double step)
    : model_(&model),
      limit_(limit),
      step_(step),
      rest_bound_(frequency_bound(model, model.rest, limit.ground_stiffness)) {}

double StepWatch::step_for(const std::vector<Vec3>& x, double strain) {
  double growth = 1;
  if (strain > kSmallStrain)
    growth = std::max(1.0, frequency_bound(*model_, x, limit_.ground_stiffness) / rest_bound_);
  const double limit = stable_step(growth * limit_.omega, limit_.damping_time);
  const auto step = [&] { return std::ldexp(step_, -static_cast<int>(halvings_)); };
  while (halvings_ < kMostHalvings && step() > kTooLong * limit) ++halvings_;
  while (halvings_ > 0 && 2 * step() < kShortEnough * limit) --halvings_;
  return step();
}

}  // namespace springlod
