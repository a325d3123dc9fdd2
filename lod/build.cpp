#include "lod/build.hpp"

#include <utility>

#include <fmt/format.h>

#include "model/error.hpp"

namespace springlod {
namespace {

std::string told_from(const SimplifyOptions& options) {
  const GroupingOptions& g = options.grouping;
  std::string grouping = to_string(g.grouping);
  if (options.groups) grouping = "groups of the script";
  if (g.pair_cost || g.node_priority) grouping = "function of the script";
  return fmt::format("{}, border {}, seed {}{}{}", grouping, to_string(g.border), g.seed,
                     options.mass == MassRule::proximity ? ", mass by proximity" : "",
                     options.guards ? "" : ", no guards");
}

Groups raw_groups(const Level& finer, const SpringRows& springs, const SimplifyOptions& options,
                  std::uint32_t level) {
  return options.groups ? options.groups(finer.model, finer.of_base, level)
                        : group_nodes(finer.model, springs, options.grouping);
}

GuardedGroups guarded(const Level& finer, const SpringRows& springs, const Groups& groups,
                      const SimplifyOptions& options) {
  GuardOptions guard = options.guard;
  guard.border = options.grouping.border;
  return guard_groups(finer.model, springs, groups, guard);
}

void require_coarser(const Level& finer, const Groups& groups, const SimplifyOptions& options,
                     std::uint32_t level) {
  if (groups.count < finer.model.node_count()) return;
  throw InputError(fmt::format(
      "simplify: level {} would be the same as level {} ({} nodes): no two nodes may merge any "
      "more; ask for levels = {}{}",
      level, level - 1, groups.count, level - 1,
      options.grouping.border == BorderRule::strong ? " or for border = \"weak\"" : ""));
}

struct Step {
  Groups groups;
  Relinking links;
};

Step next_step(const Level& finer, const SimplifyOptions& options, std::uint32_t level) {
  const SpringRows springs(finer.model);
  Groups groups = raw_groups(finer, springs, options, level);
  if (options.guards) {
    GuardedGroups sound = guarded(finer, springs, groups, options);
    return {std::move(sound.groups), std::move(sound.links)};
  }
  Relinking links = relink(springs, groups);
  return {std::move(groups), std::move(links)};
}

Level next_level(const Level& finer, const SimplifyOptions& options, std::uint32_t level) {
  Step step = next_step(finer, options, level);
  require_coarser(finer, step.groups, options, level);
  return {merge(finer.model, step.groups, std::move(step.links)),
          compose(finer.of_base, step.groups),
          options.made_by.empty() ? told_from(options) : options.made_by};
}

}  // namespace

LodChain simplify(MassSpringModel base, const SimplifyOptions& options) {
  Task task(options.progress, "merging", options.levels);
  LodChain chain;
  const std::uint32_t nodes = base.node_count();
  chain.levels.push_back({std::move(base), identity_groups(nodes), "base"});
  for (std::uint32_t level = 1; level <= options.levels; ++level) {
    chain.levels.push_back(next_level(chain.levels.back(), options, level));
    if (options.mass == MassRule::proximity)
      share_by_proximity(chain.levels.front().model, chain.levels.back().model);
    task.advance();
  }
  return chain;
}

}  // namespace springlod
