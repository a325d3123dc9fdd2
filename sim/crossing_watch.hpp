#pragma once

#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/run.hpp"

namespace springlod {

/// Looks now and then for springs that turned over: their direction differs by more than a right
/// angle from that at the look before, turned along with the body (by its angular velocity). A
/// spring only knows its length; that its ends went past each other no force tells.
class CrossingWatch {
 public:
  CrossingWatch(const MassSpringModel& model, const State& start)
      : model_(&model), before_(start) {}
  /// The first spring in the model's order that turned over since the last look.
  std::optional<Crossing> look(State state);

 private:
  const MassSpringModel* model_;
  State before_;
};

}  // namespace springlod
