#pragma once

#include <vector>

#include "sim/correction/step_nodes.hpp"
#include "sim/held/anchor_springs.hpp"

namespace springlod::sim {

/// The springs of anchors in each step of an explicit scheme, so that they do not bound it: eq. 63b
/// of docs/method.md. Each gets one force for the whole step, - k (e_0 + e_1) / 2 - c (e_1 - e_0) /
/// dt, from its node's distances e from its place at both ends. The elastic part is the discrete
/// gradient of the energy k e^2 / 2, so what it takes from the motion is stored, for any step and
/// stiffness. See StepCorrection.
class StepSprings {
 public:
  /// Springs must outlive this; null: none.
  explicit StepSprings(const AnchorSprings* springs);

  bool empty() const { return springs_ == nullptr || springs_->empty(); }

  /// Begins a step with the forces of the last one. The places are where they are at its end.
  void begin(double step, StepNodes& nodes);
  /// Updates all forces once. Returns the largest change of a node's position over the largest
  /// displacement of a node by its spring [1].
  double sweep(StepNodes& nodes);
  /// Ends the step: the nodes are at their final positions.
  void finish(StepNodes& nodes);
  /// Energy that the dampers took in the step [J], and what the sweeps left.
  double loss() const { return loss_; }
  /// Stored at the end of the last step [J].
  double energy() const { return energy_; }
  /// Adds what they did in the step.
  void book(AnchorForces& forces) const;

 private:
  struct Pull {
    Vec3 before = Vec3::Zero();  // place at the start of the step [m]
    Vec3 from = Vec3::Zero();    // e_0 [m]
    Vec3 force = Vec3::Zero();   // [N]
    double mobility = 0;         // displacement by a unit force, dt^2 / (2 m) [m/N]
    double early = 0, late = 0;  // - force = early e_0 + late e_1 [N/m]
  };

  const AnchorSprings* springs_;
  double step_ = 0;  // [s]
  std::vector<Pull> pulls_;
  std::vector<Vec3> last_places_;  // at the end of the last step [m]
  double loss_ = 0, energy_ = 0;
};

}  // namespace springlod::sim
