#pragma once

#include <cstdint>

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

/// What the kernel of a model goes through in a step, each once. It takes as long for gaps as for
/// springs.
struct StepWork {
  Kernel kernel = Kernel::quads;
  std::uint64_t eights = 0;  ///< rows, or pairs of quads: eight springs or gaps
  std::uint64_t nodes = 0;   ///< with those that pad rows, and the copies of other blocks' nodes
};

/// Of the kernel that runs the model with Layout::fastest.
StepWork step_work(const MassSpringModel& model, Precision precision);

/// Estimated processor time of a step of symplectic Euler in free flight.
struct StepTime {
  Kernel kernel = Kernel::quads;  ///< that runs the model
  double seconds = 0;             ///< on the machine of docs/speed.md, one thread [s]
};

/// The time of a step from its work and the times per step, node and eight of the kernel, which are
/// fitted to the times of runs (bench/flight_bench.cpp); eq. 50c of docs/method.md. Ratios of these
/// times hold for other machines better than the times do. Without contact and strained corners,
/// and for models whose data stay in the caches, up to about 20,000 nodes: larger ones take longer.
StepTime step_time(const MassSpringModel& model, Precision precision);

}  // namespace springlod::sim
