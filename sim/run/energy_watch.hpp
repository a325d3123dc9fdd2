#pragma once

#include <string>

#include "model/mass_spring.hpp"
#include "sim/fast/layout.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// Detects divergence: compares the kinetic energy with the total energy that could have become
/// kinetic.
class EnergyCheck {
 public:
  /// `start`: after the first kick. The check uses its v+, because the ledger's v- . v+ is negative
  /// for a body released at rest. `volumes`: whether corners resist. `precision`: of the body's
  /// state. `step` and `limit` are for the advice in the message.
  EnergyCheck(const MassSpringModel& model, const Stepper& start, bool volumes, Precision precision,
              double step, const StepLimit& limit);

  /// Throws UnstableError naming the worst node.
  void check(const Stepper& body, double gravity_work);
  /// Speed of a node below which check() cannot throw [m/s].
  double safe_speed() const;

 private:
  [[noreturn]] void throw_not_finite(const Stepper& body) const;
  std::string advice() const;

  /// Energy that was there or that gravity and anchors have given at most [J].
  double given() const { return available_ + most_gravity_work_ + most_anchor_work_; }
  double bound() const;

  double step_;
  double mass_;  // of the body [kg]
  StepLimit limit_;
  double rounding_;
  double available_ = 0;
  double most_gravity_work_ = 0;
  double most_anchor_work_ = 0;
};

}  // namespace springlod::sim
