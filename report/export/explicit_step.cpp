#include "report/export/explicit_step.hpp"

#include <cmath>

#include <fmt/format.h>

#include "elastic/stable_step.hpp"

namespace springlod::report {

double explicit_step(const MassSpringModel& model) {
  constexpr double kSafety = 0.8;  // as of RunOptions
  if (model.dilatation.empty()) return kSafety * elastic::stable_step(model);
  MassSpringModel springs = model;
  springs.dilatation = {};
  return kSafety * elastic::stable_step(springs);
}

std::string explicit_step_line(const MassSpringModel& model, double step) {
  if (!std::isfinite(step)) return "step: any, for there are no springs";
  return fmt::format(
      "step: at most {:.3g} s ({:.0f} per second), 0.8 of the stable step of symplectic Euler at "
      "rest; damping times up to {:.3g} s",
      step, std::ceil(1 / step), elastic::largest_damping_time(model));
}

}  // namespace springlod::report
