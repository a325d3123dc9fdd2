#include "sim/integrators/step_limit.hpp"

#include <algorithm>
#include <utility>

#include "elastic/stable_step.hpp"
#include "sim/contact/contact.hpp"

namespace springlod::sim {
namespace {

// The step counts as limited by damping if it is shorter than this fraction of the undamped limit
// [1].
constexpr double kDampingPart = 0.5;

}  // namespace

StepBound stable_step_bound(double step, double undamped) {
  return step < kDampingPart * undamped ? StepBound::damping : StepBound::springs;
}

StepLimit step_limit(const MassSpringModel& model, const Scenario& scenario, Integrator integrator,
                     const ContactSkin* skin) {
  const auto limit = choice_of(integrator).traits.stable_step;
  if (limit == nullptr) return {};
  elastic::FrequencyOptions contact;
  contact.ground_stiffness = contact_stiffness(
      skin != nullptr ? ContactPoints(model, *skin) : ContactPoints(model), scenario.obstacles);
  const double omega = elastic::largest_frequency(model, contact);
  if (!(omega > 0)) return {};
  double damping_time = elastic::largest_damping_time(model);
  for (const Obstacle& obstacle : scenario.obstacles)
    damping_time = std::max(damping_time, obstacle.damping);
  return {.step = limit(omega, damping_time),
          .without_damping = limit(omega, 0),
          .omega = omega,
          .damping_time = damping_time,
          .ground_stiffness = std::move(contact.ground_stiffness)};
}

double predicted_step(const MassSpringModel& model, const Scenario& scenario, Integrator integrator,
                      const ContactSkin* skin) {
  return step_limit(model, scenario, integrator, skin).step;
}

}  // namespace springlod::sim
