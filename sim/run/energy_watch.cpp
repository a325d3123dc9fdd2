#include "sim/run/energy_watch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "sim/correction/corner_law.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {
namespace {

// The kinetic energy of the half-step velocities may exceed the true energy by the factor 1 / (1 -
// (omega dt / 2)^2): 50 if all of it is in the highest mode at 0.99 of the limit. [1]
constexpr double kEnergyMargin = 100;

// Strain whose energy counts as rounding [1]: growth below it is ignored. Without damping, rounding
// errors excite a growing vibration; in single precision it reaches strains of 1e-6 within a
// second.
double rounding_strain(Precision precision) {
  return precision == Precision::single_precision ? 1e-3 : 1e-11;
}

}  // namespace

EnergyCheck::EnergyCheck(const MassSpringModel& model, const Stepper& start, bool volumes,
                         Precision precision, double step, const StepLimit& limit)
    : step_(step),
      mass_(std::accumulate(model.mass.begin(), model.mass.end(), 0.0)),
      limit_(limit),
      rounding_(std::pow(rounding_strain(precision), 2) * spring_work(model)) {
  std::uint32_t node = 0;
  available_ = start.kinetic_of_step(&node) + elastic_energy(model, start.positions()) +
               contact_energy(start.contacts()) +
               (volumes ? corner_energy(model, start.positions()) : 0);
}

void EnergyCheck::check(const Stepper& body, double gravity_work) {
  std::uint32_t node = 0;
  const double kinetic = body.kinetic_of_step(&node);
  if (!std::isfinite(kinetic)) throw_not_finite(body);
  most_anchor_work_ = std::max(most_anchor_work_, body.anchor_work());
  most_gravity_work_ = std::max(most_gravity_work_, gravity_work);
  if (kinetic > bound())
    throw UnstableError(
        fmt::format("the run became unstable: at t = {:.6g} s the kinetic energy is {:.3g} J, of "
                    "at most {:.3g} J that were there, most of it in node {}; {}",
                    body.time(), kinetic, given(), script_number(node), advice()),
        node, body.time());
}

double EnergyCheck::bound() const {
  return kEnergyMargin * given() + rounding_;
}

double EnergyCheck::safe_speed() const {
  return std::sqrt(2 * bound() / mass_);
}

void EnergyCheck::throw_not_finite(const Stepper& body) const {
  const State state = body.state();
  std::uint32_t node = 0;
  while (node + 1 < state.x.size() && state.x[node].allFinite() && state.v[node].allFinite())
    ++node;
  throw UnstableError(
      fmt::format("the run became unstable: node {} is not finite at t = {:.6g} s; {}",
                  script_number(node), body.time(), advice()),
      node, body.time());
}

std::string EnergyCheck::advice() const {
  if (step_ <= limit_.step) return "take a smaller step";
  const bool damping_alone = step_ <= limit_.without_damping;
  if (damping_alone || limit_.limited_by() == StepBound::damping)
    return fmt::format(
        "damping is what bounds the step: {:.3g} s is beyond its limit of {:.3g} s ({:.3g} s "
        "without damping); take a smaller step, less damping or an implicit integrator",
        step_, limit_.step, limit_.without_damping);
  return fmt::format("{:.3g} s is beyond the limit of {:.3g} s; take a smaller step", step_,
                     limit_.step);
}

}  // namespace springlod::sim
