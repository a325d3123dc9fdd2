#include "sim/study/level_cost.hpp"

#include <algorithm>
#include <limits>

#include "sim/integrators/step_limit.hpp"

namespace springlod::sim {
namespace {

// Steps of a timed run: enough to outlast the resolution of the clock and the first passes, in
// which the model is not yet in the cache.
constexpr double kTimedSteps = 256;

// Timed runs, of which the fastest counts: the others were disturbed by other programs.
constexpr int kTimedRuns = 3;

// Step of a body without a stability limit [s]; that of the implicit schemes.
constexpr double kUnlimitedStep = 1e-3;

}  // namespace

double cost_of(const Trajectory& run) {
  const double awake = run.asleep_since.value_or(run.simulated);
  return awake > 0 ? run.processor_seconds / awake : 0;
}

double measured_cost(const MassSpringModel& model, const Scenario& scenario,
                     const RunOptions& options, const RunPlan& plan) {
  const double limit = std::min(plan.limit->step, kUnlimitedStep / options.safety);
  const double step = options.step ? *options.step : options.safety * limit;
  Scenario flight = scenario;
  flight.obstacles.clear();
  flight.measure_from.clear();
  flight.stop.reset();
  flight.duration = kTimedSteps * step;
  RunOptions timed = options;
  timed.frame_rate = 0;
  timed.progress = nullptr;
  timed.skin = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimedRuns; ++i)
    least = std::min(
        least, cost_of(run(model, flight, initial_state(model, scenario.start), timed, plan)));
  return least;
}

}  // namespace springlod::sim
