#pragma once

#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/run.hpp"

namespace springlod::sim {

/// Checks all springs at intervals for strain and, in a model without corners, for inversion. (The
/// corners of a model are checked in every step: see Stepper::inversions.)
class SpringCheck {
 public:
  SpringCheck(const MassSpringModel& model, const State& start) : model_(&model), before_(start) {}
  void check(State state);

  /// The first inverted spring in the model's order. Its direction differs by more than a right
  /// angle from that at the previous check, rotated with the body (by its angular velocity). The
  /// force depends on the length alone and does not reveal that the ends moved past each other.
  const std::optional<Crossing>& first_crossing() const { return first_crossing_; }
  /// Largest |l - L| / L of the last check [1].
  double largest_strain() const { return largest_strain_; }

 private:
  /// Rotation of the body since the previous check.
  Mat3 rotation_until(double time) const;

  const MassSpringModel* model_;
  State before_;
  std::optional<Crossing> first_crossing_;
  double largest_strain_ = 0;
};

}  // namespace springlod::sim
