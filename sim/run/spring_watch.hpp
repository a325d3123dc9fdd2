#pragma once

#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/run.hpp"

namespace springlod::sim {

/// Looks now and then at all springs.
class SpringWatch {
 public:
  SpringWatch(const MassSpringModel& model, const State& start) : model_(&model), before_(start) {}
  void look(State state);

  /// The first spring, in the model's order, that was seen turned over: its direction differed by
  /// more than a right angle from that at the look before, turned along with the body (by its
  /// angular velocity). A spring only knows its length; that its ends went past each other no force
  /// tells.
  const std::optional<Crossing>& first_crossing() const { return first_crossing_; }
  /// Largest |l - L| / L of the last look [1].
  double largest_strain() const { return largest_strain_; }

 private:
  const MassSpringModel* model_;
  State before_;
  std::optional<Crossing> first_crossing_;
  double largest_strain_ = 0;
};

}  // namespace springlod::sim
