#include "lod/calibration/elastic_targets.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "elastic/stable_step.hpp"
#include "lod/group_means.hpp"
#include "model/anchors.hpp"

namespace springlod::lod {
namespace {

/// Number of load cases solved together. A larger block reads the factors less often, but each load
/// case needs the memory of six copies of the positions.
constexpr std::size_t kTogether = 32;

void check_weight(const char* name, double weight) {
  if (!(weight >= 0 && std::isfinite(weight)))
    throw InputError(fmt::format("calibration: {} = {} must be 0 or more", name, weight));
}

void check(const TargetOptions& options) {
  check_weight("piece_weight", options.piece_weight);
  check_weight("patch_weight", options.patch_weight);
  check_weight("mode_weight", options.mode_weight);
  check_weight("shape_weight", options.shape_weight);
  check_weight("load_weight", options.load_weight);
  for (const TargetRegion& region : options.regions)
    check_weight("weight of a region", region.weight);
  const bool any_load = options.kinds != TargetKinds::modes;
  if (!any_load && !options.regions.empty())
    throw InputError(
        "calibration: targets = \"modes\" excludes the loads of regions; leave out regions, or use "
        "targets = \"loads\" or \"both\"");
  if ((mode_count(options) == 0 || (options.mode_weight == 0 && options.shape_weight == 0)) &&
      (!any_load || options.load_weight == 0))
    throw InputError("calibration: no targets are left; use modes or loads with a weight above 0");
}

std::vector<elastic::StaticLoad> region_loads(const MassSpringModel& base,
                                              const TargetRegion& region,
                                              const TargetOptions& options, std::size_t number) {
  elastic::LocalLoadOptions local{.count = region.patches / 2,
                                  .seed = options.seed + number,
                                  .within = movable_nodes(base, region, options.anchored)};
  if (local.within.empty()) return {};
  std::vector<elastic::StaticLoad> loads = elastic::patch_pairs(base, local);
  local.count = region.patches - static_cast<std::uint32_t>(loads.size());
  std::vector<elastic::StaticLoad> single = elastic::pushes(base, local);
  std::move(single.begin(), single.end(), std::back_inserter(loads));
  for (elastic::StaticLoad& load : loads) load.name += fmt::format(" of region {}", number);
  return loads;
}

/// LoadTarget::compliance of the loads for each level.
std::vector<std::vector<double>> compliances(const MassSpringModel& base,
                                             const elastic::ElasticBody& body,
                                             const std::vector<LoadTarget>& targets,
                                             const std::vector<Groups>& levels,
                                             const std::function<bool()>& stopped) {
  std::vector<std::vector<double>> all(levels.size());
  for (std::size_t first = 0; first < targets.size(); first += kTogether) {
    if (stopped()) throw InterruptedError();
    const std::size_t last = std::min(targets.size(), first + kTogether);
    std::vector<elastic::StaticLoad> loads;
    for (std::size_t l = first; l < last; ++l) loads.push_back(targets[l].load);
    const std::vector<elastic::StaticSolution> solved = elastic::solve_static(
        body, loads, {.relative_tolerance = kLoadBalance, .balance_free_motions = true});
    for (std::size_t level = 0; level < levels.size(); ++level)
      for (std::size_t l = 0; l < loads.size(); ++l)
        all[level].push_back(
            work_on_means(loads[l].force, solved[l].displacement, base.mass, levels[level]));
  }
  return all;
}

}  // namespace

elastic::StaticLoad summed_over_groups(const Groups& of_base, const elastic::StaticLoad& load) {
  elastic::StaticLoad coarse{load.name, std::vector<Vec3>(of_base.count, Vec3::Zero())};
  for (std::size_t i = 0; i < load.force.size(); ++i) coarse.force[of_base.of[i]] += load.force[i];
  return coarse;
}

std::vector<std::uint32_t> movable_nodes(const MassSpringModel& base, const TargetRegion& region,
                                         const Support& anchored) {
  const std::vector<std::uint8_t> held = anchor_flags(base, anchored.nodes);
  std::vector<std::uint32_t> nodes;
  for (const std::uint32_t node : region.nodes)
    if (base.border.at(node) != 0 && held[node] == 0) nodes.push_back(node);
  return nodes;
}

std::uint32_t mode_count(const TargetOptions& options) {
  return options.kinds == TargetKinds::loads ? 0 : options.modes;
}

std::uint32_t patch_count(const TargetOptions& options, std::uint32_t nodes) {
  if (options.kinds == TargetKinds::modes) return 0;
  if (options.patches) return *options.patches;
  constexpr double kMost = 150, kLeast = 60, kFew = 2000;
  return static_cast<std::uint32_t>(std::clamp(kMost * std::sqrt(kFew / nodes), kLeast, kMost));
}

std::vector<LoadTarget> target_loads(const MassSpringModel& base, const TargetOptions& options) {
  check(options);
  std::vector<LoadTarget> targets;
  const auto add = [&](LoadKind kind, double weight, std::vector<elastic::StaticLoad> loads) {
    for (elastic::StaticLoad& load : loads)
      targets.push_back({kind, std::move(load), 0, weight * options.load_weight});
  };
  if (options.kinds != TargetKinds::modes) {
    add(LoadKind::smooth, 1, elastic::smooth_loads(base));
    add(LoadKind::piece, options.piece_weight, elastic::piece_loads(base));
  }
  const std::uint32_t patches = patch_count(options, base.node_count());
  if (patches > 0 && border_count(base) > 0) {
    // A level is too stiff for each kind unless that kind is fitted: a third each.
    const auto local = [&](std::uint32_t kind) {
      return elastic::LocalLoadOptions{.count = (patches + 2 - kind) / 3, .seed = options.seed};
    };
    add(LoadKind::patch, options.patch_weight, elastic::patch_pairs(base, local(0)));
    add(LoadKind::patch, options.patch_weight, elastic::pinches(base, local(1)));
    add(LoadKind::patch, options.patch_weight, elastic::pushes(base, local(2)));
  }
  for (std::size_t r = 0; r < options.regions.size(); ++r)
    add(LoadKind::region, options.regions[r].weight,
        region_loads(base, options.regions[r], options, r + 1));
  return targets;
}

BaseMeasurements measure_base(const MassSpringModel& base, const TargetOptions& options,
                              const std::vector<LoadTarget>& loads,
                              const std::vector<Groups>& levels) {
  const elastic::ElasticBody body =
      elastic::elastic_body(base, {.anchored = options.anchored, .progress = options.progress});
  BaseMeasurements measured;
  run_jobs(2, options.threads, [&](std::uint64_t job, const std::function<bool()>& stopped) {
    const std::uint32_t modes = mode_count(options);
    if (job == 0 && modes > 0)
      for (const elastic::Mode& mode :
           elastic::lowest_modes(body, {.count = modes, .progress = options.progress}).modes) {
        measured.squared_frequency.push_back(mode.angular_frequency * mode.angular_frequency);
        std::vector<Vec3>& force = measured.modal_forces.emplace_back(mode.shape);
        for (std::uint32_t i = 0; i < base.node_count(); ++i) force[i] *= base.mass[i];
      }
    if (job == 1) measured.compliance = compliances(base, body, loads, levels, stopped);
  });
  measured.highest_frequency = elastic::largest_frequency(base);
  return measured;
}

ElasticTargets make_targets(const MassSpringModel& base, const TargetOptions& options,
                            std::vector<LoadTarget> loads, const BaseMeasurements& measured,
                            std::size_t level) {
  ElasticTargets targets;
  targets.squared_frequency = measured.squared_frequency;
  targets.mode_weight = options.mode_weight;
  targets.shape_weight = options.shape_weight;
  if (options.shape_weight > 0) targets.modal_forces = measured.modal_forces;
  targets.loads = std::move(loads);
  for (std::size_t l = 0; l < targets.loads.size(); ++l)
    targets.loads[l].compliance = measured.compliance.at(level).at(l);
  // A load without effect on the groups is dropped, such as a stretch across a flat model.
  std::erase_if(targets.loads, [](const LoadTarget& target) { return !(target.compliance > 0); });
  targets.highest_frequency = measured.highest_frequency;
  targets.nodes = base.node_count();
  targets.anchored = options.anchored;
  return targets;
}

ElasticTargets measure_targets(const MassSpringModel& base, const Groups& of_base,
                               const TargetOptions& options) {
  std::vector<LoadTarget> loads = target_loads(base, options);
  const BaseMeasurements measured = measure_base(base, options, loads, {of_base});
  return make_targets(base, options, std::move(loads), measured, 0);
}

}  // namespace springlod::lod
