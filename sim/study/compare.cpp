#include "sim/study/compare.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "lod/transfer.hpp"
#include "sim/study/deviation.hpp"
#include "sim/study/ensemble.hpp"
#include "sim/study/run_progress.hpp"

namespace springlod::sim {
namespace {

// Interval in which a level that waits for its base looks whether the comparison has been stopped.
constexpr std::chrono::milliseconds kPatience{10};

// Tolerance by which a frame at the end of the window may seem to be later [s].
constexpr double kRounding = 1e-9;

bool same_base(const MassSpringModel& p, const MassSpringModel& q) {
  return p.rest == q.rest && p.mass == q.mass && p.a == q.a && p.b == q.b &&
         p.rest_length == q.rest_length && p.stiffness == q.stiffness && p.damping == q.damping &&
         p.contact_area == q.contact_area && p.corners.size() == q.corners.size() &&
         p.dilatation.modulus == q.dilatation.modulus && p.surface.area == q.surface.area;
}

void validate(const std::vector<const LodChain*>& chains, const CompareOptions& options,
              const std::vector<std::string>& variants) {
  if (chains.empty()) throw InputError("compare: there are no chains");
  for (std::size_t c = 0; c < chains.size(); ++c) {
    if (chains[c]->levels.empty()) throw InputError("compare: the chain has no levels");
    if (!same_base(chains[c]->levels[0].model, chains[0]->levels[0].model))
      throw InputError(fmt::format(
          "compare: chain {} has another base than the first; compare it by a call of its own",
          c + 1));
  }
  if (!variants.empty() && variants.size() != chains.size())
    throw InputError(
        fmt::format("compare: {} variants do not name {} chains", variants.size(), chains.size()));
  if (options.starts == 0) throw InputError("compare: starts = 0 must be 1 or more");
  if (!(options.jitter >= 0 && options.jitter < 1))
    throw InputError(fmt::format("compare: jitter = {} must lie in [0, 1)", options.jitter));
  if (!(std::isfinite(options.error_window) && options.error_window >= 0))
    throw InputError(
        fmt::format("compare: error_window = {} must be 0 or more seconds", options.error_window));
}

/// Data of the base's run that the levels of one start need.
struct BaseRun {
  std::vector<Frame> frames;
  std::vector<LedgerEntry> ledger;
  std::optional<double> first_contact;
};

/// Shares the base's run with the levels of the same start and frees it after the last of them.
struct StartSlot {
  std::promise<std::shared_ptr<BaseRun>> promise;
  std::shared_future<std::shared_ptr<BaseRun>> base = promise.get_future().share();
  std::atomic<std::uint32_t> users{0};
};

struct Errors {
  double surface = 0;
  double shape = 0;
};

Errors mean_errors(const std::vector<Frame>& frames, const BaseRun& base,
                   const std::vector<double>& mass, double window) {
  const double window_end =
      base.first_contact ? *base.first_contact + window : base.frames.back().time;
  const std::vector<Deviation> deviations = deviation_over_time(frames, base.frames, mass);
  Errors sum;
  std::size_t in_window = 0;
  for (const Deviation& d : deviations) {
    sum.shape += d.shape;
    if (d.time > window_end + kRounding) continue;
    ++in_window;
    sum.surface += d.surface;
  }
  // The first frame, t = 0, is always common and in the window.
  return {sum.surface / static_cast<double>(in_window),
          sum.shape / static_cast<double>(deviations.size())};
}

/// Largest difference of the mechanical energy over the base's largest kinetic energy; the ledgers
/// hold one entry per frame.
double energy_difference(const std::vector<LedgerEntry>& ledger,
                         const std::vector<LedgerEntry>& base) {
  double largest = 0;
  double kinetic = 0;
  for (const LedgerEntry& entry : base) kinetic = std::max(kinetic, entry.kinetic);
  for (std::size_t i = 0; i < std::min(ledger.size(), base.size()); ++i)
    largest = std::max(largest, std::abs(ledger[i].mechanical() - base[i].mechanical()));
  return kinetic > 0 ? largest / kinetic : 0;
}

/// One call of `compare`.
class Comparing {
 public:
  Comparing(const std::vector<const LodChain*>& chains, const Scenario& scenario,
            const CompareOptions& options, const std::vector<std::string>& variants)
      : options_(options),
        base_(chains.front()->levels.front().model),
        base_center_(center_of_mass(base_, base_.rest)),
        starts_(starts_differ(scenario, base_center_, options.jitter, options.run.anchors)
                    ? options.starts
                    : 1),
        slots_(starts_),
        results_(chains.size()) {
    for (std::size_t c = 0; c < chains.size(); ++c) {
      Comparison& result = results_[c];
      result.scenario = scenario;
      result.error_window = options.error_window;
      result.levels.resize(chains[c]->levels.size());
      for (std::uint32_t level = 0; level < result.levels.size(); ++level) {
        result.levels[level].level = level;
        result.levels[level].label = level_label(level, variants.empty() ? "" : variants[c]);
        result.levels[level].starts.resize(starts_);
        if (c == 0 || level > 0) add_runner(*chains[c], level, result.levels[level]);
      }
    }
    for (StartSlot& slot : slots_) slot.users = static_cast<std::uint32_t>(runners_.size());
  }

  std::vector<Comparison> run_all() {
    const std::uint64_t jobs = std::uint64_t{starts_} * runners_.size();
    Task task(options_.progress, "compare", jobs * RunProgress::kUnits);
    // Ordered by start, the base first: when a level waits for its base, the base's run has already
    // begun.
    run_jobs(jobs, options_.threads, [&](std::uint64_t job, const std::function<bool()>& stopped) {
      const auto start = static_cast<std::uint32_t>(job / runners_.size());
      const Runner& runner = runners_[job % runners_.size()];
      if (runner.runs.level == 0)
        run_base(runner, start, stopped);
      else
        run_coarser(runner, start, stopped);
    });
    for (std::size_t c = 1; c < results_.size(); ++c)
      results_[c].levels.front() = results_.front().levels.front();
    return std::move(results_);
  }

 private:
  /// What the runs of one level share.
  struct Runner {
    const MassSpringModel& model;
    Binding base_of_level;
    RunOptions options;
    RunPlan plan;
    LevelRuns& runs;  // their results
  };

  void add_runner(const LodChain& chain, std::uint32_t level, LevelRuns& runs) {
    RunOptions run = options_.run;
    run.anchors = mapped(options_.run.anchors, chain.levels[level].of_base);
    if (options_.contact.value_or(chain.contact) == ContactAt::surface && level > 0)
      run.skin = std::make_shared<ContactSkin>(contact_skin(chain, level));
    const MassSpringModel& model = chain.levels[level].model;
    RunPlan plan = plan_runs(model, results_.front().scenario, run);
    runners_.push_back(
        {model, lod::base_from_level(chain, level), std::move(run), std::move(plan), runs});
  }

  void run_base(const Runner& runner, std::uint32_t start, const std::function<bool()>& stopped) {
    auto base = std::make_shared<BaseRun>();
    try {
      Trajectory trajectory = run_level(runner, start, stopped);
      base->frames = start == 0 ? trajectory.frames : std::move(trajectory.frames);
      base->ledger = start == 0 ? trajectory.ledger : std::move(trajectory.ledger);
      base->first_contact = trajectory.first_contact;
      if (start == 0) {
        runner.runs.base_frames = trajectory.frames;
        runner.runs.first = std::move(trajectory);
      }
    } catch (...) {
      slots_[start].promise.set_exception(std::current_exception());
      throw;
    }
    slots_[start].promise.set_value(base);
    leave(start, *base);
  }

  void run_coarser(const Runner& runner, std::uint32_t start,
                   const std::function<bool()>& stopped) {
    Trajectory trajectory = run_level(runner, start, stopped);
    std::vector<Frame> base_frames = bring_back(runner.base_of_level, trajectory.frames);
    const auto base_run = slots_[start].base;  // a copy: several threads must not share one future
    // If another run failed, the base's may never start.
    while (base_run.wait_for(kPatience) != std::future_status::ready)
      if (stopped()) throw InterruptedError();
    const std::shared_ptr<BaseRun>& base = base_run.get();
    const Errors errors = mean_errors(base_frames, *base, base_.mass, options_.error_window);
    StartResult& result = runner.runs.starts[start];
    result.surface_error = errors.surface;
    result.shape_error = errors.shape;
    result.energy_difference = energy_difference(trajectory.ledger, base->ledger);
    leave(start, *base);
    if (start == 0) {
      runner.runs.first = std::move(trajectory);
      runner.runs.base_frames = std::move(base_frames);
    }
  }

  void leave(std::uint32_t start, BaseRun& base) {
    if (--slots_[start].users > 0) return;
    base.frames = {};
    base.ledger = {};
  }

  /// Runs one level and keeps the results of its own trajectory.
  Trajectory run_level(const Runner& runner, std::uint32_t start,
                       const std::function<bool()>& stopped) {
    Scenario scenario = results_.front().scenario;
    scenario.start = jittered(scenario.start, base_center_, options_.jitter, options_.seed, start);
    RunProgress progress(options_.progress, stopped);
    RunOptions run_options = runner.options;
    run_options.progress = &progress;
    Trajectory trajectory = run_start(
        runner.model, scenario, base_center_, run_options, runner.plan,
        fmt::format("{}, start {}", runner.runs.label, start + 1), runner.runs.starts[start]);
    progress.finish();
    return trajectory;
  }

  static std::vector<Frame> bring_back(const Binding& base_of_level,
                                       const std::vector<Frame>& frames) {
    std::vector<Frame> base_frames;
    base_frames.reserve(frames.size());
    for (const Frame& frame : frames)
      base_frames.push_back({frame.time, interpolate(base_of_level, frame.x)});
    return base_frames;
  }

  const CompareOptions& options_;
  const MassSpringModel& base_;
  Vec3 base_center_;
  std::uint32_t starts_;  // that are run
  std::vector<StartSlot> slots_;
  std::vector<Comparison> results_;  // by chain
  std::vector<Runner> runners_;      // the base, then the levels of each chain
};

}  // namespace

std::string level_label(std::uint32_t level, const std::string& variant) {
  if (level == 0) return "base";
  return fmt::format("{}{}level {}", variant, variant.empty() ? "" : " ", level);
}

std::optional<double> error_end(const Comparison& comparison) {
  const Trajectory& base = comparison.levels.front().first;
  if (!base.first_contact || base.frames.empty()) return {};
  const double end = *base.first_contact + comparison.error_window;
  if (end >= base.frames.back().time) return {};
  return end;
}

std::vector<Comparison> compare(const std::vector<const LodChain*>& chains,
                                const Scenario& scenario, const CompareOptions& options,
                                const std::vector<std::string>& variants) {
  validate(chains, options, variants);
  validate(scenario);
  return Comparing(chains, scenario, options, variants).run_all();
}

Comparison compare(const LodChain& chain, const Scenario& scenario, const CompareOptions& options) {
  return std::move(compare({&chain}, scenario, options, {options.variant}).front());
}

}  // namespace springlod::sim
