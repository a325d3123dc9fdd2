#pragma once

#include "base/choice.hpp"
#include "model/mass_spring.hpp"
#include "sim/fast/layout.hpp"

namespace springlod::sim {

/// Kernels of symplectic Euler.
enum class Kernel { rows, quads };

inline constexpr Choice<Kernel> kKernels[] = {
    {Kernel::rows, "rows", "eight springs of a lattice at a time, which point the same way"},
    {Kernel::quads, "quads", "four springs at a time, of any model"}};
constexpr ChoiceTable<Choice<Kernel>> choices(Kernel) {
  return {"kernel", kKernels};
}

/// Estimated processor time of a step of symplectic Euler in free flight.
struct StepTime {
  Kernel kernel = Kernel::quads;  ///< that runs the model
  double seconds = 0;             ///< on the machine of docs/speed.md, one thread [s]
};

/// The time of a step from the number of springs and the time per spring of the kernel, measured by
/// `./dev bench` (step/lattice and step/merged in bench/results/results.csv). Ratios of these times
/// hold for other machines better than the times do. Without contact and strained corners.
StepTime step_time(const MassSpringModel& model, Precision precision);

}  // namespace springlod::sim
