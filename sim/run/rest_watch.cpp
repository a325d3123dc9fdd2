#include "sim/run/rest_watch.hpp"

#include <algorithm>
#include <numeric>

namespace springlod::sim {
namespace {

// A body sleeps after it has been at rest for this long [s]: longer than a bouncing body is slow at
// the top of its path.
constexpr double kRest = 0.25;

}  // namespace

bool StopCriterion::check(const Stepper& body) {
  if (!rule_) return false;
  if (body.center_velocity().norm() >= rule_->speed) last_fast_ = body.time();
  return body.time() - last_fast_ >= rule_->hold;
}

RestCriterion::RestCriterion(const MassSpringModel& model, const Scenario& scenario, double part,
                             double awake_until)
    : awake_until_(awake_until) {
  const double mass = std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  const double square = scenario.gravity.norm() * bounds(model.rest).sizes().norm();
  most_energy_ = 0.5 * mass * part * part * square;
}

bool RestCriterion::check(const Stepper& body) {
  std::uint32_t fastest = 0;
  if (body.contacts().empty() || !(body.kinetic_of_step(&fastest) < most_energy_))
    last_awake_ = body.time();
  return body.time() - std::max(last_awake_, awake_until_) >= kRest;
}

}  // namespace springlod::sim
