#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/step_limit.hpp"

namespace springlod {

/// Whether the step that is stable about rest still is where springs are stretched and compressed
/// hard: stretched ones are stiff across their length too, and a flattened body's springs all point
/// the same way.
class StepWatch {
 public:
  /// Strains below this raise the highest frequency by less than a tenth, which every step that
  /// this watch is for leaves room for [1].
  static constexpr double kSmallStrain = 0.1;

  /// `step`: the one chosen at rest [s].
  StepWatch(const MassSpringModel& model, const StepLimit& limit, double step);

  /// The step to take from here [s]: the first one over a power of two, so that steps still add up
  /// to the same duration. `strain`: largest of the springs [1]; small ones are not looked into.
  double step_for(const std::vector<Vec3>& x, double strain);

 private:
  /// Highest frequency with nodes at x [rad/s].
  double frequency(const std::vector<Vec3>& x) const;

  const MassSpringModel* model_;
  StepLimit limit_;
  double step_;
  std::vector<double> at_rest_;  // bounds of the nodes [rad2/s2]
  std::uint32_t halvings_ = 0;
};

}  // namespace springlod
