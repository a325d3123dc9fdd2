#pragma once

#include <optional>

#include "sim/integrators/stepper.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Whether the centre of mass has been slow for long enough.
class StopWatch {
 public:
  explicit StopWatch(const std::optional<StopRule>& rule) : rule_(rule) {}
  bool look(const Stepper& body);

 private:
  std::optional<StopRule> rule_;
  double last_fast_ = 0;  // [s]
};

/// Whether a body that lies on something has come to rest: nothing would wake it.
class SleepWatch {
 public:
  /// `part`: of the speed of a fall through its own size, see RunOptions; 0: never.
  SleepWatch(const MassSpringModel& model, const Scenario& scenario, double part);
  bool look(const Stepper& body);

 private:
  double most_energy_;     // kinetic [J]
  double last_awake_ = 0;  // [s]
};

}  // namespace springlod::sim
