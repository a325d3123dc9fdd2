#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/integrators/step_limit.hpp"

namespace springlod::sim {

/// Shortens the time step while springs are strongly strained (section 8 of docs/method.md):
/// stretched springs are also stiff across their length, and the springs of a flattened body are
/// nearly parallel. A corner near inversion must be turned back within a few steps.
class StepController {
 public:
  /// Up to this strain [1], a node's stiffness grows at most by the factor 1 + 2 (1 - 1/1.25) =
  /// 1.4, and the highest frequency by 1.18: a step of 0.8 of the limit at rest remains stable.
  /// Smaller strains are not checked.
  static constexpr double kSmallStrain = 0.25;

  /// `step`: the step for the body at rest [s].
  StepController(const MassSpringModel& model, const StepLimit& limit, double step);

  /// A step in which a corner changes by more, see StepCorners::largest_change(), is too long [1]:
  /// it would follow a corner near inversion too coarsely.
  static constexpr double kCornerChange = 0.15;

  /// What a check found.
  struct Strained {
    double strain = 0;         ///< the largest strain of the springs [1]; small ones do not count
    double corner_change = 0;  ///< largest change of a corner in a step since the last check [1]
    std::uint64_t step_number = 0;
  };
  /// The step to take from here [s]: the initial step divided by a power of two, so that steps
  /// still add up to the same duration.
  double step_for(const std::vector<Vec3>& x, const Strained& found);
  /// Whether corners may halve it further.
  bool corners_may_halve() const;

 private:
  /// Highest frequency for node positions x [rad/s].
  double frequency(const std::vector<Vec3>& x);

  const MassSpringModel* model_;
  StepLimit limit_;
  double step_;
  std::vector<double> at_rest_;  // bounds of the nodes [rad2/s2]; empty until first needed
  std::uint32_t halvings_ = 0;
  std::uint64_t last_short_ = 0;  // number of the last step that was too long, or nearly
  std::uint64_t calm_;            // steps without one after which the step is doubled
};

}  // namespace springlod::sim
