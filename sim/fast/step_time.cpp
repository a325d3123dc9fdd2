#include "sim/fast/step_time.hpp"

namespace springlod::sim {
namespace {

// Times that add up to that of a step [s].
struct WorkTimes {
  double step;   // whatever the model
  double node;   // for each node of StepWork
  double eight;  // for each of its eights
};

// Fitted to the benchmarks flight/... by bench/fit_flight.lua, on a processor with AVX2: see
// "A step in flight" in docs/speed.md.
constexpr WorkTimes kRowsDouble{510e-9, 2.2e-9, 14.5e-9};
constexpr WorkTimes kRowsSingle{540e-9, 0, 8.4e-9};
constexpr WorkTimes kQuadsDouble{310e-9, 5.0e-9, 24.5e-9};
constexpr WorkTimes kQuadsSingle{290e-9, 7.2e-9, 11.1e-9};

const WorkTimes& times_of(Kernel kernel, Precision precision) {
  const bool rows = kernel == Kernel::rows;
  if (precision == Precision::single_precision) return rows ? kRowsSingle : kQuadsSingle;
  return rows ? kRowsDouble : kQuadsDouble;
}

}  // namespace

StepTime step_time(const MassSpringModel& model, Precision precision) {
  const StepWork work = step_work(model, precision);
  const WorkTimes& times = times_of(work.kernel, precision);
  return {work.kernel, times.step + times.node * static_cast<double>(work.nodes) +
                           times.eight * static_cast<double>(work.eights)};
}

}  // namespace springlod::sim
