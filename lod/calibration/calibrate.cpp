#include "lod/calibration/calibrate.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/available_memory.hpp"
#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/script_number.hpp"
#include "lod/calibration/calibration_store.hpp"
#include "lod/calibration/long_springs.hpp"
#include "lod/calibration/second_moments.hpp"
#include "model/anchors.hpp"
#include "model/components.hpp"

namespace springlod::lod {
namespace {

/// A connected component of the base, and what the targets of every level are made of.
struct MeasuredPart {
  ModelComponent part;
  std::vector<Groups> groups;  // from its nodes to those of its part of each level above the base
  TargetOptions options;
  std::vector<LoadTarget> loads;  // without compliances
  BaseMeasurements measured;      // for each level above the base
};

/// The chosen nodes that lie in the component, numbered within it.
std::vector<std::uint32_t> nodes_of_part(const ModelComponent& part,
                                         const std::vector<std::uint8_t>& chosen) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < part.nodes.size(); ++i)
    if (chosen[part.nodes[i]] != 0) nodes.push_back(i);
  return nodes;
}

/// What holds the component, numbered within it. `held`: flags of the nodes.
Support support_of_part(const ModelComponent& part, const std::vector<std::uint8_t>& held,
                        const std::vector<NodeSpring>& springs) {
  Support of_part(nodes_of_part(part, held));
  for (const NodeSpring& spring : springs) {
    const auto place = std::lower_bound(part.nodes.begin(), part.nodes.end(), spring.node);
    if (place != part.nodes.end() && *place == spring.node)
      of_part.springs.push_back(
          {static_cast<std::uint32_t>(place - part.nodes.begin()), spring.stiffness});
  }
  return of_part;
}

void require_surface(const MassSpringModel& base, const TargetOptions& options) {
  for (std::size_t r = 0; r < options.regions.size(); ++r) {
    for (const std::uint32_t node : options.regions[r].nodes)
      if (node >= base.node_count())
        throw InputError(
            fmt::format("calibration: region {} contains node {}; the base has {} nodes",
                        script_number(r), script_number(node), base.node_count()));
    if (movable_nodes(base, options.regions[r], options.anchored).empty())
      throw InputError(
          fmt::format("calibration: none of the {} nodes of region {} is a border node that is "
                      "free to move; use nodes of the surface that are not anchored",
                      options.regions[r].nodes.size(), script_number(r)));
  }
}

/// The options for a component of the base: those of the call with its own support and regions.
/// `held`: flags of the nodes that are held.
TargetOptions options_of_part(const ModelComponent& part, const std::vector<std::uint8_t>& held,
                              const std::vector<std::vector<std::uint8_t>>& regions,
                              const CalibrateOptions& options) {
  TargetOptions of_part = options.targets;
  of_part.threads = options.threads;
  of_part.progress = options.progress;
  of_part.anchored = support_of_part(part, held, options.targets.anchored.springs);
  for (std::size_t r = 0; r < regions.size(); ++r)
    of_part.regions[r].nodes = nodes_of_part(part, regions[r]);
  return of_part;
}

BaseMeasurements measure_or_load(const MassSpringModel& part, std::size_t number,
                                 const TargetOptions& options, const std::vector<LoadTarget>& loads,
                                 const std::vector<Groups>& levels, const CalibrationStore* store) {
  if (store == nullptr) return measure_base(part, options, loads, levels);
  const std::string fingerprint = fingerprint_of(part, options, levels);
  if (std::optional<BaseMeasurements> kept = store->measurements(number, fingerprint)) return *kept;
  BaseMeasurements measured = measure_base(part, options, loads, levels);
  store->keep(number, fingerprint, measured);
  return measured;
}

/// The maps from the nodes of a component of the base to those of the component that each level
/// above the base makes of it, in ascending order.
std::vector<Groups> groups_of_part(const ModelComponent& part, const LodChain& chain) {
  std::vector<Groups> all;
  for (std::size_t level = 1; level < chain.levels.size(); ++level) {
    const Groups& of_base = chain.levels[level].of_base;
    const std::vector<std::uint32_t> nodes = mapped_nodes(of_base, part.nodes);
    std::vector<std::uint32_t> place(of_base.count);
    for (std::uint32_t i = 0; i < nodes.size(); ++i) place[nodes[i]] = i;
    Groups& groups = all.emplace_back(Groups{{}, static_cast<std::uint32_t>(nodes.size())});
    for (const std::uint32_t node : part.nodes) groups.of.push_back(place[of_base.of[node]]);
  }
  return all;
}

// Cubes of 10,000 and 100,000 nodes take 55 and 64 kB a node (bench_calibrate); flat bodies, whose
// factors are sparser, less. Components are fitted one after the other.
void require_memory_for(const std::vector<ModelComponent>& parts) {
  constexpr double kLeastBytesPerNode = 30e3;
  std::size_t most = 0;
  for (const ModelComponent& part : parts) most = std::max(most, part.nodes.size());
  require_memory(kLeastBytesPerNode * static_cast<double>(most),
                 fmt::format("calibration: a body of {} nodes needs at least", most), [](double) {
                   return "use larger cells, or merge only (calibrate = \"none\", convert --fast)";
                 });
}

std::vector<MeasuredPart> measure_parts(const LodChain& chain, const CalibrateOptions& options,
                                        const CalibrationStore* store) {
  const MassSpringModel& base = chain.levels.front().model;
  require_surface(base, options.targets);
  validate(options.targets.anchored, base);
  const std::vector<std::uint8_t> held = anchor_flags(base, options.targets.anchored.nodes);
  std::vector<std::vector<std::uint8_t>> regions;
  for (const TargetRegion& region : options.targets.regions)
    regions.push_back(anchor_flags(base, region.nodes));
  std::vector<ModelComponent> parts = split_components(base, connected_components(base));
  require_memory_for(parts);
  std::vector<MeasuredPart> all;
  for (ModelComponent& part : parts) {
    const TargetOptions of_part = options_of_part(part, held, regions, options);
    std::vector<LoadTarget> loads = target_loads(part.model, of_part);
    std::vector<Groups> groups = groups_of_part(part, chain);
    BaseMeasurements measured =
        measure_or_load(part.model, all.size(), of_part, loads, groups, store);
    all.push_back(
        {std::move(part), std::move(groups), of_part, std::move(loads), std::move(measured)});
  }
  return all;
}

void write_back(const ModelComponent& part, const MassSpringModel& fitted, MassSpringModel& level) {
  for (std::size_t i = 0; i < part.nodes.size(); ++i) level.mass[part.nodes[i]] = fitted.mass[i];
  for (std::size_t s = 0; s < part.springs.size(); ++s) {
    level.stiffness[part.springs[s]] = fitted.stiffness[s];
    level.damping[part.springs[s]] = fitted.damping[s];
  }
  for (std::size_t t = 0; t < part.terms.size(); ++t)
    level.dilatation.modulus[part.terms[t]] = fitted.dilatation.modulus[t];
}

/// Saves the state of one fit at intervals [s].
class FitCheckpoint {
 public:
  FitCheckpoint(const CalibrationStore& store, std::size_t level, std::size_t part,
                std::string fingerprint, double interval)
      : store_(store),
        level_(level),
        part_(part),
        fingerprint_(std::move(fingerprint)),
        interval_(interval),
        due_(Clock::now() + interval_) {}

  std::optional<FitState> load() const { return store_.fit(level_, part_, fingerprint_); }

  /// Saves a finished fit at once, another one if the interval has passed; true if it saved.
  bool save_if_due(const FitState& state) {
    if (!state.finished && Clock::now() < due_) return false;
    save(state);
    return true;
  }

  void save(const FitState& state) {
    store_.keep(level_, part_, fingerprint_, state);
    due_ = Clock::now() + interval_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  using Seconds = std::chrono::duration<double>;

  const CalibrationStore& store_;
  std::size_t level_, part_;
  std::string fingerprint_;
  Seconds interval_;
  std::chrono::time_point<Clock, Seconds> due_;
};

std::string detail_of(std::size_t level, const FitState& state, double base_frequency) {
  constexpr double kPercent = 100;
  std::string text = fmt::format("level {}, step {}: f1..10 error {:.2g} %", level, state.iteration,
                                 kPercent * state.frequency_error);
  if (state.best_frequency > 0)
    text += fmt::format(", omega_max / base {:.2f}", state.best_frequency / base_frequency);
  return text;
}

class Calibrator {
 public:
  Calibrator(LodChain& chain, const CalibrateOptions& options) : chain_(chain), options_(options) {
    if (!(options.keep_every >= 0))
      throw InputError(
          fmt::format("calibration: keep_every = {} must be 0 or more", options.keep_every));
    if (!options.store.empty()) store_.emplace(options.store, options.progress);
    base_ = measure_parts(chain, options, store_ ? &*store_ : nullptr);
  }

  void run() {
    const std::size_t levels = chain_.levels.size() - 1;
    std::uint64_t steps = 0;
    for (std::size_t level = 1; level <= levels; ++level) steps += steps_of(level) * base_.size();
    Task task(options_.progress, "calibrating", steps);
    try {
      run_jobs(levels, options_.threads,
               [&](std::uint64_t job, const std::function<bool()>& stopped) {
                 fit_level(job + 1, stopped, task);
               });
    } catch (const InterruptedError&) {
      if (store_ && !reported_store_) report_store();
      throw;
    }
  }

 private:
  void fit_level(std::size_t number, const std::function<bool()>& stopped, Task& task) {
    Level& level = chain_.levels[number];
    restore_second_moments(chain_.levels.front().model, level.of_base, level.model);
    favour_long_springs(level.model);
    const Components components = connected_components(level.model);
    const std::vector<ModelComponent> parts = split_components(level.model, components);
    for (std::size_t p = 0; p < base_.size(); ++p) {
      const MeasuredPart& of_base = base_[p];
      const std::uint32_t first = level.of_base.of[of_base.part.nodes.front()];
      const ModelComponent& part = parts[components.of_node[first]];
      if (part.springs.empty()) {
        task.advance(steps_of(number));
        continue;
      }
      write_back(part, fit(number, p, part.model, stopped, task), level.model);
    }
  }

  MassSpringModel fit(std::size_t level, std::size_t part, const MassSpringModel& start,
                      const std::function<bool()>& stopped, Task& task) {
    const MeasuredPart& base = base_[part];
    const Groups& groups = base.groups[level - 1];
    const ElasticTargets targets =
        make_targets(base.part.model, base.options, base.loads, base.measured, level - 1);
    FitOptions options = options_.fit;
    options.iterations = steps_of(level);
    options.threads = options_.threads;
    FitProgress progress;
    std::optional<FitCheckpoint> checkpoint;
    if (store_) {
      checkpoint.emplace(*store_, level, part, fingerprint_of(targets, start, groups, options),
                         options_.keep_every);
      progress.from = checkpoint->load();
    }
    std::uint32_t reported = 0;  // steps already counted by the task
    const auto report = [&](const FitState& state) {
      if (stopped()) throw InterruptedError();
      task.detail(detail_of(level, state, targets.highest_frequency));
      const std::uint32_t done = state.finished ? options.iterations : state.iteration;
      task.advance(done - std::exchange(reported, done));
    };
    if (progress.from) {
      if (!resumed_.exchange(true))
        say(fmt::format("calibration: resumes from {}", store_->folder().string()));
      report(*progress.from);
    }
    progress.on_iteration = [&](const FitState& state) {
      try {
        report(state);
      } catch (const InterruptedError&) {
        if (checkpoint) checkpoint->save(state);
        throw;
      }
      if (checkpoint && checkpoint->save_if_due(state) && !state.finished &&
          !reported_store_.exchange(true))
        report_store();
    };
    return fit_part(start, groups, targets, options, progress);
  }

  /// Largest number of steps of each component.
  std::uint32_t steps_of(std::size_t level) const {
    return fit_steps(options_.fit, chain_.levels[level].model.node_count());
  }

  void report_store() const {
    say(fmt::format("calibration: its state is saved in {}; repeat the call to resume after a stop",
                    store_->folder().string()));
  }
  void say(const std::string& text) const {
    if (options_.progress != nullptr) options_.progress->say(text);
  }

  LodChain& chain_;
  const CalibrateOptions& options_;
  std::optional<CalibrationStore> store_;
  std::vector<MeasuredPart> base_;
  std::atomic<bool> reported_store_{false}, resumed_{false};
};

}  // namespace

void calibrate(LodChain& chain, const CalibrateOptions& options) {
  Calibrator(chain, options).run();
}

}  // namespace springlod::lod
