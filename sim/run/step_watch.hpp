#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/integrators/step_limit.hpp"

namespace springlod::sim {

/// Whether the step that is stable about rest still is where springs are stretched and compressed
/// hard: stretched ones are stiff across their length too, and a flattened body's springs all point
/// the same way.
class StepWatch {
 public:
  /// Stretched by up to this [1], a node's stiffness grows 1 + 2 (1 - 1/1.25) = 1.4 times at most,
  /// the highest frequency 1.18 times: a step of 0.8 of the limit at rest holds. Strains below are
  /// not looked into.
  static constexpr double kSmallStrain = 0.25;

  /// `step`: the one chosen at rest [s].
  StepWatch(const MassSpringModel& model, const StepLimit& limit, double step);

  /// The step to take from here [s]: the first one over a power of two, so that steps still add up
  /// to the same duration. `strain`: largest of the springs [1]; small ones are not looked into.
  double step_for(const std::vector<Vec3>& x, double strain);

 private:
  /// Highest frequency with nodes at x [rad/s].
  double frequency(const std::vector<Vec3>& x);

  const MassSpringModel* model_;
  StepLimit limit_;
  double step_;
  std::vector<double> at_rest_;  // bounds of the nodes [rad2/s2]; empty until first asked for
  std::uint32_t halvings_ = 0;
};

}  // namespace springlod::sim
