#include "sim/study/pick.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/zero_modes.hpp"
#include "lod/quality/grade.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/study/compare.hpp"
#include "sim/study/level_cost.hpp"
#include "sim/study/predict.hpp"

namespace springlod::sim {
namespace {

std::vector<PickLevel> described_levels(const LodChain& chain) {
  std::vector<PickLevel> levels;
  for (std::uint32_t level = 0; level < chain.levels.size(); ++level) {
    const MassSpringModel& model = chain.levels[level].model;
    levels.push_back(
        {.level = level, .nodes = model.node_count(), .springs = model.spring_count()});
  }
  return levels;
}

std::uint32_t mechanisms(std::uint32_t zero_modes, std::uint32_t expected) {
  return zero_modes - std::min(expected, zero_modes);
}

/// A body whose base has mechanisms, such as a rope, may keep them.
void mark_faulty(const LodChain& chain, std::vector<PickLevel>& levels) {
  std::optional<std::uint32_t> of_base;
  for (PickLevel& level : levels) {
    const std::optional<Certificate>& c = chain.levels[level.level].certificate;
    if (!c || lod::grade(*c) != lod::Grade::faulty) continue;
    const std::uint32_t found = mechanisms(c->zero_modes, c->expected_zero_modes);
    if (!of_base) {
      of_base = 0;
      for (const elastic::ComponentModes& part : elastic::zero_modes(chain.levels[0].model))
        *of_base += mechanisms(part.zero_modes, part.expected);
    }
    level.faulty = found == 0 || found > *of_base;
  }
}

void measure(const LodChain& chain, const Scenario& scenario, const PickOptions& options,
             Pick& pick) {
  const Comparison runs = compare(chain, scenario,
                                  {.threads = options.threads,
                                   .run = options.run,
                                   .contact = options.contact,
                                   .error_window = options.error_window,
                                   .progress = options.progress});
  pick.no_contact = no_contact(runs.levels.front().first, scenario);
  for (PickLevel& level : pick.levels) {
    const LevelRuns& own = runs.levels[level.level];
    level.error = own.starts.front().surface_error;
    level.cost = cost_of(own.first);
  }
}

/// Adds the time of contacts to costs without them. At nodes, it is the same fraction for all
/// levels. At the surface, all levels have the contact points of the base, so it is the same for a
/// step; the base has nodes there.
void add_contacts(const Prediction& prediction, ContactAt contact,
                  const std::vector<RunPlan>& plans, std::vector<PickLevel>& levels) {
  const double flight = levels[prediction.probe].cost;
  const double factor = std::max(1.0, prediction.cost_at_nodes / flight);
  const double more = std::max(0.0, prediction.cost_at_surface - flight);
  const double probe_step = plans[prediction.probe].limit->step;
  for (PickLevel& level : levels) {
    const double step = plans[level.level].limit->step;
    if (contact == ContactAt::nodes || level.level == 0)
      level.cost *= factor;
    else
      level.cost += std::isfinite(step) ? more * probe_step / step : more;
  }
}

void predict(const LodChain& chain, const Scenario& scenario, const PickOptions& options,
             Pick& pick) {
  const ContactAt contact = options.contact.value_or(chain.contact);
  const Prediction prediction = predict_errors(chain, scenario,
                                               {.error_window = options.error_window,
                                                .threads = options.threads,
                                                .run = options.run,
                                                .contact = contact,
                                                .progress = options.progress});
  pick.no_contact = prediction.no_contact;
  std::vector<RunPlan> plans;
  for (PickLevel& level : pick.levels) {
    const MassSpringModel& model = chain.levels[level.level].model;
    plans.push_back(plan_runs(model, scenario, options.run));
    level.error = prediction.levels[level.level].error;
    level.cost = measured_cost(model, scenario, options.run, plans.back());
  }
  if (prediction.probe > 0) add_contacts(prediction, contact, plans, pick.levels);
}

}  // namespace

void validate(const LodChain& chain, const PickOptions& options) {
  if (chain.levels.size() < 2)
    throw InputError(
        "pick: the chain has only its base, so there is nothing to pick; build levels with "
        "simplify or springlod convert --levels 2");
  if (options.error.has_value() == options.budget.has_value())
    throw InputError(options.error ? "pick: error and budget are both given; give one of them"
                                   : "pick: give error (such as \"2 %\") or budget (such as "
                                     "\"2 ms\")");
  if (options.error && !(*options.error > 0 && *options.error < 1))
    throw InputError(fmt::format(
        "pick: error = {0:g} must be above 0 and below 1: it is a fraction of the base's "
        "diagonal; write \"{0:g} %\" for {0:g} per cent",
        *options.error));
  if (options.budget && !(*options.budget > 0))
    throw InputError(
        fmt::format("pick: budget = {:g} must be above 0 seconds a frame", *options.budget));
  if (!(std::isfinite(options.error_window) && options.error_window >= 0))
    throw InputError(
        fmt::format("pick: error_window = {} must be 0 or more seconds", options.error_window));
  if (!(options.run.frame_rate > 0))
    throw InputError(
        fmt::format("pick: frame_rate = {} must be above 0 frames per second: costs are those of a "
                    "frame",
                    options.run.frame_rate));
}

std::optional<std::uint32_t> choose_level(std::vector<PickLevel>& levels,
                                          const PickOptions& options) {
  std::optional<std::uint32_t> picked;
  for (PickLevel& level : levels) {
    level.within = !level.faulty &&
                   (options.error ? level.error <= *options.error : level.cost <= *options.budget);
    if (!level.within) continue;
    if (!picked || options.error || level.error < levels[*picked].error) picked = level.level;
  }
  return picked;
}

Pick pick_level(const LodChain& chain, const Scenario& scenario, const PickOptions& options) {
  validate(chain, options);
  validate(scenario);
  Pick pick{.options = options, .levels = described_levels(chain), .level = std::nullopt};
  pick.options.progress = nullptr;
  mark_faulty(chain, pick.levels);
  if (options.measure)
    measure(chain, scenario, options, pick);
  else
    predict(chain, scenario, options, pick);
  const double diagonal = bounds(chain.levels.front().model.rest).diagonal().norm();
  for (PickLevel& level : pick.levels) {
    level.error /= diagonal;
    level.cost /= options.run.frame_rate;
  }
  pick.level = choose_level(pick.levels, options);
  return pick;
}

}  // namespace springlod::sim
