#pragma once

#include <string>

#include "model/mass_spring.hpp"
#include "sim/fast/layout.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// Compares the kinetic energy with all that could have become kinetic energy so far.
class EnergyWatch {
 public:
  /// `start`: after the first kick. Its v+ count, not the ledger's v- . v+, which is negative for a
  /// body released at rest. `precision`: that the body moves with. `step` and `limit` are for what
  /// the message advises.
  EnergyWatch(const MassSpringModel& model, const Stepper& start, Precision precision, double step,
              const StepLimit& limit);

  /// Throws UnstableError naming the worst node.
  void look(const Stepper& body, double gravity_work);

 private:
  [[noreturn]] void throw_not_finite(const Stepper& body) const;
  std::string advice() const;

  double step_;
  StepLimit limit_;
  double rounding_;
  double available_ = 0;
  double most_gravity_work_ = 0;
};

}  // namespace springlod::sim
