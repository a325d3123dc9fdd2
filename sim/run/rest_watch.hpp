#pragma once

#include <optional>

#include "sim/integrators/stepper.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Stop rule of a scenario: whether the centre of mass has been slow for long enough.
class StopCriterion {
 public:
  explicit StopCriterion(const std::optional<StopRule>& rule) : rule_(rule) {}
  bool check(const Stepper& body);

 private:
  std::optional<StopRule> rule_;
  double last_fast_ = 0;  // [s]
};

/// Rest criterion: whether a body in contact has come to rest (eq. 63 of docs/method.md).
class RestCriterion {
 public:
  /// `part`: RunOptions::sleep, a fraction of the speed after a fall through its size; 0: never.
  /// `awake_until`: it does not sleep before that time [s].
  RestCriterion(const MassSpringModel& model, const Scenario& scenario, double part,
                double awake_until);
  bool check(const Stepper& body);

 private:
  double most_energy_;     // kinetic [J]
  double awake_until_;     // [s]
  double last_awake_ = 0;  // [s]
};

}  // namespace springlod::sim
