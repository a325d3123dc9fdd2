#pragma once

#include "base/choice.hpp"

namespace springlod::sim {

/// What determines the time step of a run.
enum class StepBound {
  springs,
  damping,
  asked,
  duration,
  scheme,
};

inline constexpr Choice<StepBound> kStepBounds[] = {
    {StepBound::springs, "springs", "highest frequency of the springs"},
    {StepBound::damping, "damping",
     "damping time of the springs: without it, the step would be more than twice as long"},
    {StepBound::asked, "asked", "the option step"},
    {StepBound::duration, "duration", "at least 100 steps in the duration"},
    {StepBound::scheme, "scheme", "default step of the implicit schemes"}};
constexpr ChoiceTable<Choice<StepBound>> choices(StepBound) {
  return {"limited_by", kStepBounds};
}

/// What determines a stable step [s]: `damping` if the step is shorter than half of the stable step
/// without damping, otherwise `springs`. Symplectic Euler reaches one half if the damping ratio of
/// the highest mode is 3/4.
StepBound stable_step_bound(double step, double undamped);

}  // namespace springlod::sim
