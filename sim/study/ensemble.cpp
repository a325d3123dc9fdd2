#include "sim/study/ensemble.hpp"

#include <functional>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "sim/study/run_progress.hpp"

namespace springlod::sim {

std::vector<EnsembleRun> run_ensemble(const MassSpringModel& model, const Scenario& scenario,
                                      const EnsembleOptions& options) {
  validate(scenario);
  if (options.starts == 0) throw InputError("ensemble: starts = 0 must be 1 or more");
  if (!(options.jitter >= 0 && options.jitter < 1))
    throw InputError(fmt::format("ensemble: jitter = {} must lie in [0, 1)", options.jitter));
  const Vec3 center = center_of_mass(model, model.rest);
  const RunPlan plan = plan_runs(model, scenario, options.run);
  std::vector<EnsembleRun> runs(options.starts);
  Task task(options.progress, "ensemble", options.starts * RunProgress::kUnits);
  run_jobs(options.starts, options.threads,
           [&](std::uint64_t job, const std::function<bool()>& stopped) {
             EnsembleRun& result = runs[job];
             result.start = options.first_start + static_cast<std::uint32_t>(job);
             Scenario own = scenario;
             own.start =
                 jittered(scenario.start, center, options.jitter, options.seed, result.start);
             RunProgress progress(options.progress, stopped);
             RunOptions run_options = options.run;
             run_options.progress = &progress;
             run_start(model, own, center, run_options, plan,
                       fmt::format("start {}", result.start + 1), result);
             progress.finish();
           });
  return runs;
}

}  // namespace springlod::sim
