#include "lod/calibrate.hpp"

#include <utility>

#include <fmt/format.h>

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

/// 1 for each of the nodes.
std::vector<std::uint8_t> node_flags(const MassSpringModel& model,
                                     const std::vector<std::uint32_t>& nodes) {
  std::vector<std::uint8_t> flags(model.node_count(), 0);
  for (const std::uint32_t node : nodes) flags.at(node) = 1;
  return flags;
}

/// The nodes of a part among some of the model's, as the part numbers them.
std::vector<std::uint32_t> nodes_of_part(const ModelPart& part,
                                         const std::vector<std::uint8_t>& chosen) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < part.nodes.size(); ++i)
    if (chosen[part.nodes[i]] != 0) nodes.push_back(i);
  return nodes;
}

void require_surface(const MassSpringModel& base, const TargetOptions& options) {
  for (std::size_t r = 0; r < options.regions.size(); ++r)
    if (movable_nodes(base, options.regions[r], options.anchored).empty())
      throw InputError(
          fmt::format("calibration: none of the {} nodes of region {} is a border node that is "
                      "free to move; name nodes of the surface, beside the anchored ones",
                      options.regions[r].nodes.size(), r + 1));
}

/// The options for a part of the base: its own anchored nodes and regions.
TargetOptions options_of_part(const ModelPart& part, const std::vector<std::uint8_t>& anchored,
                              const std::vector<std::vector<std::uint8_t>>& regions,
                              const CalibrateOptions& options) {
  TargetOptions of_part = options.targets;
  of_part.progress = options.progress;
  of_part.anchored = nodes_of_part(part, anchored);
  for (std::size_t r = 0; r < regions.size(); ++r)
    of_part.regions[r].nodes = nodes_of_part(part, regions[r]);
  return of_part;
}

std::vector<PartTargets> measure_parts(const MassSpringModel& base,
                                       const CalibrateOptions& options) {
  require_surface(base, options.targets);
  const std::vector<std::uint8_t> anchored = node_flags(base, options.targets.anchored);
  std::vector<std::vector<std::uint8_t>> regions;
  for (const TargetRegion& region : options.targets.regions)
    regions.push_back(node_flags(base, region.nodes));
  std::vector<PartTargets> all;
  for (ModelPart& part : split_parts(base, connected_components(base))) {
    ElasticTargets targets =
        measure_targets(part.model, options_of_part(part, anchored, regions, options));
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
