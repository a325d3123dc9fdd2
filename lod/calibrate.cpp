#include "lod/calibrate.hpp"

#include <utility>

#include "lod/long_springs.hpp"
#include "lod/second_moments.hpp"
#include "model/error.hpp"
#include "model/parallel.hpp"
#include "model/parts.hpp"

namespace springlod {
namespace {

/// A part of the base with its targets.
struct PartTargets {
  ModelPart part;
  ElasticTargets targets;
};

std::vector<PartTargets> measure_parts(const MassSpringModel& base,
                                       const CalibrateOptions& options) {
  std::vector<PartTargets> all;
  std::vector<bool> anchored(base.node_count(), false);
  for (const std::uint32_t node : options.targets.anchored) anchored.at(node) = true;
  for (ModelPart& part : split_parts(base, connected_components(base))) {
    TargetOptions of_part = options.targets;
    of_part.progress = options.progress;
    of_part.anchored.clear();
    for (std::uint32_t i = 0; i < part.nodes.size(); ++i)
      if (anchored[part.nodes[i]]) of_part.anchored.push_back(i);
    ElasticTargets targets = measure_targets(part.model, of_part);
    all.push_back({std::move(part), std::move(targets)});
  }
  return all;
}

/// Nodes of a part of the base -> nodes of the part of the level that they went into.
Groups groups_of_part(const ModelPart& base, const ModelPart& level, const Groups& of_base) {
  Groups groups{{}, level.model.node_count()};
  std::vector<std::uint32_t> place(of_base.count);
  for (std::uint32_t i = 0; i < level.nodes.size(); ++i) place[level.nodes[i]] = i;
  for (const std::uint32_t node : base.nodes) groups.of.push_back(place[of_base.of[node]]);
  return groups;
}

void write_back(const ModelPart& part, const MassSpringModel& fitted, MassSpringModel& level) {
  for (std::size_t i = 0; i < part.nodes.size(); ++i) level.mass[part.nodes[i]] = fitted.mass[i];
  for (std::size_t s = 0; s < part.springs.size(); ++s) {
    level.stiffness[part.springs[s]] = fitted.stiffness[s];
    level.damping[part.springs[s]] = fitted.damping[s];
  }
}

void calibrate_level(const std::vector<PartTargets>& base, Level& level,
                     const FitOptions& options) {
  const Components components = connected_components(level.model);
  const std::vector<ModelPart> parts = split_parts(level.model, components);
  for (const PartTargets& of_base : base) {
    const std::uint32_t first = level.of_base.of[of_base.part.nodes.front()];
    const ModelPart& part = parts[components.of_node[first]];
    if (part.springs.empty()) continue;
    const Groups groups = groups_of_part(of_base.part, part, level.of_base);
    write_back(part, fit_part(part.model, groups, of_base.targets, options), level.model);
  }
}

}  // namespace

void calibrate(LodChain& chain, const CalibrateOptions& options) {
  const MassSpringModel& base = chain.levels.front().model;
  const std::vector<PartTargets> targets = measure_parts(base, options);
  Task task(options.progress, "calibrating",
            (chain.levels.size() - 1) * options.fit.iterations * targets.size());
  run_jobs(chain.levels.size() - 1, options.threads,
           [&](std::uint64_t job, const std::function<bool()>& stopped) {
             Level& level = chain.levels[job + 1];
             restore_second_moments(base, level.of_base, level.model);
             favour_long_springs(level.model);
             FitOptions fit = options.fit;
             fit.on_iteration = [&] {
               if (stopped()) throw InterruptedError();
               task.advance();
             };
             calibrate_level(targets, level, fit);
           });
}

}  // namespace springlod
