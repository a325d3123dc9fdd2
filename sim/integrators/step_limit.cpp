#include "sim/integrators/step_limit.hpp"

#include "elastic/stable_step.hpp"

namespace springlod::sim {
namespace {

// The step counts as limited by damping if it is shorter than this fraction of the undamped limit
// [1].
constexpr double kDampingPart = 0.5;

}  // namespace

StepBound stable_step_bound(double step, double undamped) {
  return step < kDampingPart * undamped ? StepBound::damping : StepBound::springs;
}

StepLimit step_limit(const MassSpringModel& model, Integrator integrator,
                     std::span<const std::uint32_t> held) {
  const auto limit = choice_of(integrator).traits.stable_step;
  if (limit == nullptr) return {};
  const double omega = elastic::largest_frequency(model, 1, held);
  if (!(omega > 0)) return {};
  const double damping_time = elastic::largest_damping_time(model);
  return {.step = limit(omega, damping_time),
          .without_damping = limit(omega, 0),
          .omega = omega,
          .damping_time = damping_time};
}

double predicted_step(const MassSpringModel& model, Integrator integrator,
                      std::span<const std::uint32_t> held) {
  return step_limit(model, integrator, held).step;
}

}  // namespace springlod::sim
