#include "sim/study/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "sim/integrators/dilatation.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/study/run_progress.hpp"
#include "sim/study/stability_body.hpp"
#include "sim/study/stiffness_ratio.hpp"

namespace springlod::sim {
namespace {

void require_positive(const std::vector<double>& values, const char* name) {
  for (const double value : values)
    if (!(std::isfinite(value) && value > 0))
      throw InputError(
          fmt::format("stability: {}: {} must be a finite number above 0", name, value));
}

void validate(const LodChain& chain, const StabilityOptions& options) {
  if (chain.levels.empty()) throw InputError("stability: the chain has no levels");
  for (const std::uint32_t level : options.levels)
    if (level >= chain.levels.size())
      throw InputError(fmt::format("stability: levels: {} is not there; the chain has 0 to {}",
                                   level, chain.levels.size() - 1));
  if (options.ratios.empty() || options.integrators.empty() || options.iterations.empty())
    throw InputError("stability: give at least one ratio, one integrator and one of iterations");
  require_positive(options.ratios, "ratios");
  require_positive(options.steps, "steps");
  require_positive(options.implicit_steps, "implicit_steps");
  require_positive(options.sweep_steps, "sweep_steps");
  require_positive(options.absolute_steps, "absolute_steps");
  require_positive({options.periods}, "periods");
  sim::validate(options.anchors, chain.levels.front().model);
  if (options.duration) require_positive({*options.duration}, "duration");
}

template <class T>
std::vector<T> sorted_once(std::vector<T> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

std::vector<Integrator> integrators_of(const LodChain& chain, const StabilityOptions& options) {
  std::vector<Integrator> integrators = options.integrators;
  const bool has_terms = !chain.levels.front().model.dilatation.empty();
  if (has_terms && integrators == all_choices<Integrator>())
    std::erase_if(integrators, [](Integrator integrator) { return !knows_terms(integrator); });
  return integrators;
}

std::vector<std::uint32_t> levels_of(const LodChain& chain, const StabilityOptions& options) {
  if (!options.levels.empty()) return sorted_once(options.levels);
  std::vector<std::uint32_t> levels(chain.levels.size());
  std::iota(levels.begin(), levels.end(), 0U);
  return levels;
}

// Smallest number of steps of an explicit run. At 1.1 of the limit, speeds grow by the factor 2.4
// per step (Runge-Kutta: 1.9), and an instability grows from rounding errors within 50 steps.
constexpr double kLeastSteps = 200;

/// Steps of a scheme [s].
std::vector<double> steps_of(const StabilityPoint& point, const StabilityBody& body,
                             const StabilityOptions& options) {
  if (!options.absolute_steps.empty()) return sorted_once(options.absolute_steps);
  const bool free = is_implicit(point.integrator);
  std::vector<double> steps = choice_of(point.integrator).traits.swept ? options.sweep_steps
                              : free                                   ? options.implicit_steps
                                                                       : options.steps;
  for (double& step : steps) step *= free ? body.period : point.limit;
  return sorted_once(steps);
}

/// The verdict on a completed run.
Verdict judge(const StabilityBody& body, const StabilityPoint& point, const Trajectory& run) {
  if (!point.stable) return Verdict::runaway;
  if (run.unconverged_steps > 0) return Verdict::unconverged;
  if (run.first_crossing || run.inversions.first) return Verdict::crossed;
  if (body.frequency_error > kOffDesign) return Verdict::off_design;
  if (std::abs(point.energy_drift) > kDrifting) return Verdict::drifting;
  if (point.error > kInaccurate) return Verdict::inaccurate;
  return Verdict::stable;
}

double worst_drift(const std::vector<LedgerEntry>& ledger) {
  double worst = 0;
  const double first = ledger.front().total();
  double available = first;  // with what moving anchors have added
  for (const LedgerEntry& entry : ledger) {
    available = std::max(available, first + entry.anchor_work);
    const double drift = (entry.total() - entry.lost_scheme - first) / available;
    if (std::abs(drift) > std::abs(worst)) worst = drift;
  }
  return worst;
}

/// The work of one call of stability_map.
class Mapping {
 public:
  Mapping(const LodChain& chain, const StabilityOptions& options)
      : chain_(chain),
        options_(options),
        levels_(levels_of(chain, options)),
        ratios_(sorted_once(options.ratios)) {}

  StabilityMap map() {
    map_.stiff_part = stiff_part(chain_.levels.front().model).name;
    rescale();
    make_specimens();
    list_points();
    probe_points();
    return std::move(map_);
  }

 private:
  void rescale() {
    at_ratio_.resize(ratios_.size());
    Task task(options_.progress, "stability: modes", ratios_.size());
    run_jobs(ratios_.size(), options_.threads, [&](std::uint64_t job, const auto& stopped) {
      if (stopped()) throw InterruptedError();
      at_ratio_[job] =
          std::make_shared<const RescaledChain>(rescaled_chain(chain_, ratios_[job], options_));
      task.advance();
    });
  }

  void make_specimens() {
    for (const std::uint32_t level : levels_) {
      const std::vector<std::uint32_t> loose = loose_nodes(chain_.levels[level], options_.anchors);
      for (const double ratio : ratios_) {
        StabilityBody& body = map_.bodies.emplace_back();
        body.level = level;
        body.ratio = ratio;
        body.loose_nodes = static_cast<std::uint32_t>(loose.size());
        if (!loose.empty()) body.loosest_node = loose.front();
      }
    }
    specimens_.resize(map_.bodies.size());
    // A reference needs two runs.
    Task task(options_.progress, "stability: references",
              2 * map_.bodies.size() * RunProgress::kUnits);
    run_jobs(map_.bodies.size(), options_.threads, [&](std::uint64_t job, const auto& stopped) {
      // The last ratios take longest. They run first, so that threads finish at about the same
      // time.
      const std::size_t body = map_.bodies.size() - 1 - job;
      RunProgress fine(options_.progress, stopped);
      RunProgress check(options_.progress, stopped);
      specimens_[body] = make_specimen(at_ratio_[body % ratios_.size()], options_, {&fine, &check},
                                       map_.bodies[body]);
      fine.finish();
      check.finish();
    });
  }

  void list_points() {
    for (std::uint32_t body = 0; body < map_.bodies.size(); ++body)
      for (const Integrator integrator : integrators_of(chain_, options_)) {
        const std::vector<std::uint32_t> once{0};
        for (const std::uint32_t iterations :
             choice_of(integrator).traits.swept ? options_.iterations : once) {
          StabilityPoint point;
          point.body = body;
          point.integrator = integrator;
          point.iterations = iterations_of(integrator, {.iterations = iterations});
          add_steps(point);
        }
      }
  }

  void add_steps(StabilityPoint point) {
    const StabilityBody& body = map_.bodies[point.body];
    point.limit = is_implicit(point.integrator) ? body.limit
                                                : predicted_step(model_of(point), point.integrator,
                                                                 specimens_[point.body].held);
    for (const double step : steps_of(point, body, options_)) {
      point.step = step;
      map_.points.push_back(point);
    }
  }

  void probe_points() {
    Task task(options_.progress, "stability: points", map_.points.size() * RunProgress::kUnits);
    run_jobs(map_.points.size(), options_.threads, [&](std::uint64_t job, const auto& stopped) {
      RunProgress progress(options_.progress, stopped);
      probe(map_.points[map_.points.size() - 1 - job], progress);
      progress.finish();
    });
  }

  void probe(StabilityPoint& point, RunProgress& progress) const {
    const StabilityBody& body = map_.bodies[point.body];
    if (body.loose_nodes > 0) {
      point.verdict = Verdict::mechanism;
      point.node = body.loosest_node;
      return;
    }
    const Specimen& specimen = specimens_[point.body];
    const RunOptions run_options{.integrator = point.integrator,
                                 .solver = {.iterations = point.iterations},
                                 .step = point.step,
                                 .frame_rate = kSamples / body.duration,
                                 .anchors = specimen.anchors,
                                 .progress = &progress};
    Scenario scene = specimen.scene;
    const double least_steps = is_implicit(point.integrator) ? 1 : kLeastSteps;
    scene.duration = std::max(scene.duration, least_steps * point.step);
    try {
      const Trajectory found = run(model_of(point), scene, specimen.start, run_options);
      point.finished = true;
      point.energy_drift = worst_drift(found.ledger);
      point.stable = point.energy_drift < kRunaway;
      point.error = specimen.error(model_of(point), found.frames);
      point.cost = static_cast<double>(found.spring_updates) / found.simulated;
      point.unconverged_steps = found.unconverged_steps;
      point.wall_seconds = found.wall_seconds;
      if (found.first_crossing) point.node = found.first_crossing->a;
      if (found.inversions.first)
        point.node = model_of(point).corners[found.inversions.first->corner].node[0];
      point.verdict = judge(body, point, found);
    } catch (const UnstableError& e) {
      point.verdict = Verdict::diverged;
      point.diverged_at = e.time();
      point.node = e.node();
    }
  }

  const MassSpringModel& model_of(const StabilityPoint& point) const {
    const LodChain& chain = specimens_[point.body].at_ratio->chain;
    return chain.levels[map_.bodies[point.body].level].model;
  }

  const LodChain& chain_;
  const StabilityOptions& options_;
  std::vector<std::uint32_t> levels_;
  std::vector<double> ratios_;
  std::vector<std::shared_ptr<const RescaledChain>> at_ratio_;
  std::vector<Specimen> specimens_;  // by body
  StabilityMap map_;
};

}  // namespace

StabilityMap stability_map(const LodChain& chain, const StabilityOptions& options) {
  validate(chain, options);
  return Mapping(chain, options).map();
}

}  // namespace springlod::sim
