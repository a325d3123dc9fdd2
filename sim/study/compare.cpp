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

void validate(const LodChain& chain, const CompareOptions& options) {
  if (chain.levels.empty()) throw InputError("compare: the chain has no levels");
  if (options.starts == 0) throw InputError("compare: starts = 0 must be 1 or more");
  if (!(options.jitter >= 0 && options.jitter < 1))
    throw InputError(fmt::format("compare: jitter = {} must lie in [0, 1)", options.jitter));
  if (!(std::isfinite(options.error_window) && options.error_window >= 0))
    throw InputError(
        fmt::format("compare: error_window = {} must be 0 or more seconds", options.error_window));
}

std::string label_of(std::uint32_t level, const std::string& variant) {
  if (level == 0) return "base";
  return fmt::format("{}{}level {}", variant, variant.empty() ? "" : " ", level);
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
  Comparing(const LodChain& chain, const Scenario& scenario, const CompareOptions& options)
      : chain_(chain), options_(options), slots_(options.starts) {
    result_.scenario = scenario;
    result_.error_window = options.error_window;
    for (StartSlot& slot : slots_) slot.users = static_cast<std::uint32_t>(chain.levels.size());
    for (std::uint32_t level = 0; level < chain.levels.size(); ++level) {
      bindings_.push_back(lod::base_from_level(chain, level));
      RunOptions& run = run_options_.emplace_back(options.run);
      run.anchors = mapped(options.run.anchors, chain.levels[level].of_base);
      if (options.contact.value_or(chain.contact) == ContactAt::surface && level > 0)
        run.skin = std::make_shared<ContactSkin>(contact_skin(chain, level));
      plans_.push_back(plan_runs(chain.levels[level].model, scenario, run));
      LevelRuns& runs = result_.levels.emplace_back();
      runs.level = level;
      runs.label = label_of(level, options.variant);
      runs.starts.resize(options.starts);
    }
    const MassSpringModel& base = chain.levels[0].model;
    base_center_ = center_of_mass(base, base.rest);
  }

  Comparison run_all() {
    const std::uint64_t jobs = std::uint64_t{options_.starts} * chain_.levels.size();
    Task task(options_.progress, "compare", jobs * RunProgress::kUnits);
    // Ordered by start, the base first: when a level waits for its base, the base's run has already
    // begun.
    run_jobs(jobs, options_.threads, [&](std::uint64_t job, const std::function<bool()>& stopped) {
      const auto start = static_cast<std::uint32_t>(job / chain_.levels.size());
      const auto level = static_cast<std::uint32_t>(job % chain_.levels.size());
      if (level == 0)
        run_base(start, stopped);
      else
        run_coarser(level, start, stopped);
    });
    return std::move(result_);
  }

 private:
  void run_base(std::uint32_t start, const std::function<bool()>& stopped) {
    auto base = std::make_shared<BaseRun>();
    try {
      Trajectory trajectory = run_level(0, start, stopped);
      base->frames = start == 0 ? trajectory.frames : std::move(trajectory.frames);
      base->ledger = start == 0 ? trajectory.ledger : std::move(trajectory.ledger);
      base->first_contact = trajectory.first_contact;
      if (start == 0) {
        result_.levels[0].base_frames = trajectory.frames;
        result_.levels[0].first = std::move(trajectory);
      }
    } catch (...) {
      slots_[start].promise.set_exception(std::current_exception());
      throw;
    }
    slots_[start].promise.set_value(base);
    leave(start, *base);
  }

  void run_coarser(std::uint32_t level, std::uint32_t start, const std::function<bool()>& stopped) {
    Trajectory trajectory = run_level(level, start, stopped);
    std::vector<Frame> base_frames = bring_back(level, trajectory.frames);
    const auto base_run = slots_[start].base;  // a copy: several threads must not share one future
    // If another run failed, the base's may never start.
    while (base_run.wait_for(kPatience) != std::future_status::ready)
      if (stopped()) throw InterruptedError();
    const std::shared_ptr<BaseRun>& base = base_run.get();
    const Errors errors =
        mean_errors(base_frames, *base, chain_.levels[0].model.mass, options_.error_window);
    StartResult& result = result_.levels[level].starts[start];
    result.surface_error = errors.surface;
    result.shape_error = errors.shape;
    result.energy_difference = energy_difference(trajectory.ledger, base->ledger);
    leave(start, *base);
    if (start == 0) {
      result_.levels[level].first = std::move(trajectory);
      result_.levels[level].base_frames = std::move(base_frames);
    }
  }

  void leave(std::uint32_t start, BaseRun& base) {
    if (--slots_[start].users > 0) return;
    base.frames = {};
    base.ledger = {};
  }

  /// Runs one level and keeps the results of its own trajectory.
  Trajectory run_level(std::uint32_t level, std::uint32_t start,
                       const std::function<bool()>& stopped) {
    const MassSpringModel& model = chain_.levels[level].model;
    Scenario scenario = result_.scenario;
    scenario.start = jittered(scenario.start, base_center_, options_.jitter, options_.seed, start);
    RunProgress progress(options_.progress, stopped);
    RunOptions run_options = run_options_[level];
    run_options.progress = &progress;
    LevelRuns& runs = result_.levels[level];
    Trajectory trajectory =
        run_start(model, scenario, base_center_, run_options, plans_[level],
                  fmt::format("{}, start {}", runs.label, start + 1), runs.starts[start]);
    progress.finish();
    return trajectory;
  }

  std::vector<Frame> bring_back(std::uint32_t level, const std::vector<Frame>& frames) const {
    std::vector<Frame> base_frames;
    base_frames.reserve(frames.size());
    for (const Frame& frame : frames)
      base_frames.push_back({frame.time, interpolate(bindings_[level], frame.x)});
    return base_frames;
  }

  const LodChain& chain_;
  const CompareOptions& options_;
  std::vector<StartSlot> slots_;
  std::vector<Binding> bindings_;        // level 0 from each level
  std::vector<RunOptions> run_options_;  // by level
  std::vector<RunPlan> plans_;           // by level
  Vec3 base_center_;
  Comparison result_;
};

}  // namespace

std::optional<double> error_end(const Comparison& comparison) {
  const Trajectory& base = comparison.levels.front().first;
  if (!base.first_contact || base.frames.empty()) return {};
  const double end = *base.first_contact + comparison.error_window;
  if (end >= base.frames.back().time) return {};
  return end;
}

Comparison compare(const LodChain& chain, const Scenario& scenario, const CompareOptions& options) {
  validate(chain, options);
  validate(scenario);
  return Comparing(chain, scenario, options).run_all();
}

}  // namespace springlod::sim
