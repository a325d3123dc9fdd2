#include "lod/build.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "lod/calibration/calibrate.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/rescale_moduli.hpp"
#include "lod/grouping/exact_count.hpp"
#include "lod/grouping/grouping.hpp"
#include "lod/merging/guard.hpp"
#include "lod/merging/mechanisms.hpp"
#include "lod/merging/merge.hpp"
#include "lod/merging/merge_corners.hpp"
#include "lod/merging/merge_dilatation.hpp"
#include "lod/quality/certify.hpp"

namespace springlod::lod {
namespace {

std::string summary_of(const SimplifyOptions& options) {
  const GroupingOptions& g = options.grouping;
  std::string grouping = to_string(g.grouping);
  if (options.groups) grouping = "groups of the script";
  return fmt::format("{}, border {}, seed {}{}{}", grouping, to_string(g.border), g.seed,
                     options.mass == MassRule::proximity ? ", mass by proximity" : "",
                     options.guards ? "" : ", no guards");
}

bool straight_from_base(const SimplifyOptions& options) {
  return options.straight ||
         (!options.groups && choice_of(options.grouping.grouping).traits.from_base);
}

/// Number of nodes that the next level should have; 0: the grouping determines it.
std::uint32_t wanted_nodes(const LodChain& chain, const SimplifyOptions& options,
                           std::uint32_t level) {
  if (options.groups || (options.keep.empty() && !straight_from_base(options))) return 0;
  constexpr double kUsual = 0.45;  // average fraction that groups of 2 or 3 nodes leave
  const std::uint32_t base = chain.levels.front().model.node_count();
  const std::uint32_t before = chain.levels.back().model.node_count();
  const auto part_of = [](double part, std::uint32_t nodes) {
    return std::max(1U, static_cast<std::uint32_t>(std::lround(part * nodes)));
  };
  if (!options.keep.empty()) return part_of(options.keep[level - 1], base);
  const std::uint32_t usual = part_of(std::pow(kUsual, level), base);
  // The guards may have left few nodes in the level before.
  return usual < before ? usual : part_of(kUsual, before);
}

/// Groups of the nodes of `finer`, before guards: `wanted` groups unless that is 0.
Groups raw_groups(const Level& finer, const SpringRows& springs, const SimplifyOptions& options,
                  std::uint32_t level, std::uint32_t wanted) {
  if (options.groups) return options.groups(finer.model, finer.of_base, level);
  const GroupingChoice& grouping = choice_of(options.grouping.grouping);
  Groups groups = grouping.make({finer.model, springs, wanted, options.grouping});
  if (grouping.traits.from_base) return groups;
  while (wanted > 0 && groups.count > wanted) {
    const MassSpringModel merged = merge_springs(finer.model, groups, relink(springs, groups));
    Groups more = group_nodes(merged, options.grouping);
    if (more.count == merged.node_count()) break;
    groups = compose(groups, more);
  }
  if (wanted > 0) split_to_count(finer.model, springs, wanted, groups);
  return groups;
}

GuardOptions guard_of(const SimplifyOptions& options) {
  GuardOptions guard = options.guard;
  guard.border = options.grouping.border;
  return guard;
}

GuardedGroups guarded_step(const Level& finer, const SpringRows& springs, Groups groups,
                           const SimplifyOptions& options) {
  if (!options.guards) {
    Relinking links = relink(springs, groups);
    return {std::move(groups), std::move(links)};
  }
  return guard_groups(finer.model, springs, groups, guard_of(options));
}

/// The number of groups after the guards that is nearest to `wanted`, of some attempts; usually
/// `wanted` itself. If the guards fuse n groups, the next attempt requests n more; surplus groups
/// are then fused, the smallest first.
GuardedGroups step_near(const Level& finer, const SpringRows& springs,
                        const SimplifyOptions& options, std::uint32_t level, std::uint32_t wanted) {
  constexpr int kTries = 20;
  const auto miss = [wanted](const GuardedGroups& step) {
    return step.groups.count > wanted ? step.groups.count - wanted : wanted - step.groups.count;
  };
  std::uint32_t requested = wanted;
  std::optional<GuardedGroups> nearest;
  for (int i = 0; i < kTries; ++i) {
    GuardedGroups step = guarded_step(
        finer, springs, raw_groups(finer, springs, options, level, requested), options);
    if (step.groups.count > wanted) {
      fuse_to_count(finer.model, options.grouping.border, wanted, step.groups);
      step = guarded_step(finer, springs, std::move(step.groups), options);
    }
    const std::uint32_t found = step.groups.count;
    if (!nearest || miss(step) < miss(*nearest)) nearest = std::move(step);
    if (found == wanted) break;
    // One more group in each attempt; otherwise the same groups could recur.
    requested =
        std::min(requested + (found < wanted ? wanted - found : 0) + 1, finer.model.node_count());
  }
  return std::move(*nearest);
}

/// Merges by `step`, without mechanisms; groups of a script stay as they are.
RegroupedStep sound_step(const Level& finer, const SpringRows& springs,
                         const SimplifyOptions& options, std::uint32_t before, GuardedGroups step) {
  if (options.guards && !options.groups)
    return without_mechanisms(finer.model, springs, std::move(step), before, guard_of(options));
  MassSpringModel merged = merge_springs(finer.model, step.groups, std::move(step.links));
  return {std::move(step.groups), std::move(merged)};
}

/// `before`: number of nodes of the level before.
RegroupedStep next_step(const Level& finer, const SimplifyOptions& options, std::uint32_t level,
                        std::uint32_t wanted, std::uint32_t before) {
  const SpringRows springs(finer.model);
  if (wanted == 0)
    return sound_step(
        finer, springs, options, before,
        guarded_step(finer, springs, raw_groups(finer, springs, options, level, 0), options));
  RegroupedStep step = sound_step(finer, springs, options, before,
                                  step_near(finer, springs, options, level, wanted));
  // Without `keep`, the number is only the usual one.
  if (!options.keep.empty() && step.groups.count != wanted)
    throw InputError(
        fmt::format("simplify: keep asks for {} nodes in level {}, but the guards and the border "
                    "rule leave {}; "
                    "change keep, or leave it out to get a possible number",
                    wanted, level, step.groups.count));
  return step;
}

void require_coarser(const Level& finer, const Groups& groups, const SimplifyOptions& options,
                     std::uint32_t level, std::uint32_t wanted) {
  const std::uint32_t before = finer.model.node_count();
  if (groups.count < before) return;
  if (!options.keep.empty() && wanted >= before)
    throw InputError(fmt::format(
        "simplify: keep asks for {} nodes in level {}, and level {} has {} nodes; use a smaller "
        "fraction or fewer levels",
        wanted, level, level - 1, before));
  throw InputError(fmt::format(
      "simplify: level {} is the coarsest possible one, because {}; use levels = {}{}", level - 1,
      groups.count == 1 ? "it has 1 node"
                        : fmt::format("no two of its {} nodes can merge", groups.count),
      level - 1, options.grouping.border == BorderRule::strong ? " or border = \"weak\"" : ""));
}

std::string regrouped_remark(std::uint32_t nodes) {
  return nodes == 0 ? "" : fmt::format(", {} nodes regrouped to stay rigid", nodes);
}

Level next_level(const LodChain& chain, const SimplifyOptions& options, std::uint32_t level) {
  const Level& finer = straight_from_base(options) ? chain.levels.front() : chain.levels.back();
  const std::uint32_t wanted = wanted_nodes(chain, options, level);
  RegroupedStep step =
      next_step(finer, options, level, wanted, chain.levels.back().model.node_count());
  require_coarser(chain.levels.back(), step.groups, options, level, wanted);
  Level coarse{std::move(step.merged), compose(finer.of_base, step.groups),
               (options.made_by.empty() ? summary_of(options) : options.made_by) +
                   regrouped_remark(step.regrouped) + choice_of(options.calibrate).remark};
  coarse.model.corners = merge_corners(finer.model.corners, step.groups, coarse.model.rest);
  // From the base: from level to level, the shares of the terms would spread further each time.
  coarse.model.dilatation =
      merge_dilatation(chain.levels.front().model, coarse.of_base, coarse.model);
  return coarse;
}

void check(const SimplifyOptions& options) {
  double before = 1;
  for (const double part : options.keep) {
    if (!(part > 0 && part < before))
      throw InputError(
          fmt::format("simplify: keep has {}; its numbers must fall from level to level and be "
                      "between 1 and 0",
                      part));
    before = part;
  }
  if (!options.keep.empty() && options.keep.size() != options.levels)
    throw InputError(fmt::format("simplify: keep is for {} levels, but levels = {}; leave one out",
                                 options.keep.size(), options.levels));
  if (options.groups && !options.keep.empty())
    throw InputError(
        "simplify: keep cannot be met by the groups of a script (a list or function as grouping, "
        "node_priority, pair_cost); leave keep out");
  const GroupingChoice& grouping = choice_of(options.grouping.grouping);
  if (!options.groups && !grouping.traits.follows_border &&
      options.grouping.border != BorderRule::none)
    throw InputError(fmt::format(
        "simplify: grouping = \"{}\" has no border rules; leave border out or use grouping = "
        "\"compact\"",
        grouping.name));
  if (options.calibrate == Calibrate::modes && options.mass == MassRule::proximity)
    throw InputError(
        "simplify: calibrate = \"modes\" determines the masses; leave out mass = \"proximity\"");
}

}  // namespace

LodChain simplify(MassSpringModel base, const SimplifyOptions& options) {
  check(options);
  LodChain chain;
  chain.contact = options.contact;
  const std::uint32_t nodes = base.node_count();
  chain.levels.push_back({std::move(base), identity_groups(nodes), "base"});
  {
    Task task(options.progress, "merging", options.levels);
    for (std::uint32_t level = 1; level <= options.levels; ++level) {
      chain.levels.push_back(next_level(chain, options, level));
      if (options.mass == MassRule::proximity)
        share_by_proximity(chain.levels.front().model, chain.levels.back().model);
      task.advance();
    }
  }
  if (options.calibrate == Calibrate::moduli)
    for (std::uint32_t level = 1; level <= options.levels; ++level)
      rescale_moduli(chain.levels.front().model, chain.levels[level].model);
  if (options.calibrate == Calibrate::modes) {
    CalibrateOptions calibration = options.calibration;
    calibration.progress = options.progress;
    calibrate(chain, calibration);
    certify(chain, {.modes = std::max(1U, mode_count(calibration.targets)),
                    .anchored = calibration.targets.anchored,
                    .tolerance = calibration.fit.tolerance,
                    .threads = calibration.threads,
                    .progress = options.progress});
  }
  return chain;
}

}  // namespace springlod::lod
