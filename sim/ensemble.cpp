#include "sim/ensemble.hpp"

#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "model/error.hpp"
#include "sim/parallel.hpp"
#include "sim/run_progress.hpp"
#include "sim/starts.hpp"

namespace springlod {

std::vector<EnsembleRun> run_ensemble(const MassSpringModel& model, const Scenario& scenario,
                                      const EnsembleOptions& options) {
  validate(scenario);
  if (options.starts == 0) throw InputError("ensemble: starts = 0 must be 1 or more");
  if (!(options.jitter >= 0 && options.jitter < 1))
    throw InputError(fmt::format("ensemble: jitter = {} must lie in [0, 1)", options.jitter));
  const Vec3 center = center_of_mass(model, model.rest);
  std::vector<EnsembleRun> runs(options.starts);
  Task task(options.progress, "ensemble", options.starts * RunProgress::kUnits);
  run_jobs(
      options.starts, options.threads,
      [&](std::uint64_t job, const std::function<bool()>& stopped) {
        EnsembleRun& result = runs[job];
        result.start = options.first_start + static_cast<std::uint32_t>(job);
        Scenario own = scenario;
        own.start = jittered(scenario.start, center, options.jitter, options.seed, result.start);
        RunProgress progress(options.progress, stopped);
        RunOptions run_options = options.run;
        run_options.progress = &progress;
        try {
          const Trajectory trajectory = run(model, own, run_options);
          progress.finish();
          result.distance = measured_distance(own, own.start.placed ? own.start.position : center,
                                              center_of_mass(model, trajectory.final.x));
          result.simulated = trajectory.simulated;
          result.spring_updates = trajectory.spring_updates;
          result.ledger_error = closure_error(trajectory.ledger);
        } catch (const UnstableError& e) {
          throw UnstableError(fmt::format("start {}: {}", result.start + 1, e.what()), e.node(),
                              e.time());
        }
      });
  return runs;
}

}  // namespace springlod
