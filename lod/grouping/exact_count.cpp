#include "lod/grouping/exact_count.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"

namespace springlod::lod {
namespace {

/// The last node of a breadth-first search within the group from its first member. Removing it
/// leaves the other nodes connected.
std::uint32_t last_reached(const SpringRows& springs, const Groups& groups,
                           const std::vector<std::uint32_t>& members) {
  std::vector<std::uint32_t> reached{members.front()};
  for (std::size_t i = 0; i < reached.size(); ++i)
    springs.for_each(reached[i], [&](std::uint32_t j, std::uint32_t) {
      if (groups.of[j] == groups.of[members.front()] &&
          std::find(reached.begin(), reached.end(), j) == reached.end())
        reached.push_back(j);
    });
  return reached.back();
}

/// The data of the merged nodes that the choice of partners needs.
struct Merged {
  std::vector<std::uint32_t> size;
  std::vector<Vec3> center;
  std::vector<std::uint8_t> border;
  std::vector<std::uint32_t> material;  // of the first node
};

Merged merged_nodes(const MassSpringModel& model, const Groups& groups) {
  Merged merged{
      std::vector<std::uint32_t>(groups.count, 0), std::vector<Vec3>(groups.count, Vec3::Zero()),
      std::vector<std::uint8_t>(groups.count, 0), std::vector<std::uint32_t>(groups.count, 0)};
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const std::uint32_t g = groups.of[i];
    if (merged.size[g]++ == 0) merged.material[g] = model.material[i];
    merged.center[g] += model.rest[i];
    merged.border[g] |= model.border[i];
  }
  for (std::uint32_t g = 0; g < groups.count; ++g) merged.center[g] /= merged.size[g];
  return merged;
}

bool may_fuse(const Merged& merged, BorderRule rule, std::uint32_t g, std::uint32_t h) {
  if (merged.material[g] != merged.material[h]) return false;
  if (rule == BorderRule::weak) return merged.border[g] == merged.border[h];
  return rule == BorderRule::none || (merged.border[g] == 0 && merged.border[h] == 0);
}

/// For each group the nearest joined group that it may be fused with; itself if there is none.
std::vector<std::uint32_t> partners(const MassSpringModel& model, const Groups& groups,
                                    const Merged& merged, BorderRule rule) {
  std::vector<std::uint32_t> partner(groups.count);
  std::iota(partner.begin(), partner.end(), 0U);
  std::vector<double> distance(groups.count, std::numeric_limits<double>::infinity());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const std::uint32_t g = groups.of[model.a[s]];
    const std::uint32_t h = groups.of[model.b[s]];
    if (g == h || !may_fuse(merged, rule, g, h)) continue;
    const double apart = (merged.center[g] - merged.center[h]).norm();
    for (const auto& [from, to] : {std::pair(g, h), std::pair(h, g)})
      if (apart < distance[from]) {
        distance[from] = apart;
        partner[from] = to;
      }
  }
  return partner;
}

/// Fuses up to `most` pairs, the smallest groups first, each group at most once.
Groups fuse_pairs(const Groups& groups, const Merged& merged,
                  const std::vector<std::uint32_t>& partner, std::uint32_t most) {
  std::vector<std::uint32_t> order(groups.count);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t g, std::uint32_t h) {
    return merged.size[g] < merged.size[h];
  });
  std::vector<bool> taken(groups.count, false);
  DisjointSets fused(groups.count);
  for (const std::uint32_t g : order) {
    if (most == 0) break;
    const std::uint32_t h = partner[g];
    if (g == h || taken[g] || taken[h]) continue;
    taken[g] = taken[h] = true;
    fused.unite(g, h);
    --most;
  }
  DisjointSets::Numbers numbers = fused.numbers();
  return compose(groups, {std::move(numbers.of), numbers.count});
}

}  // namespace

void split_to_count(const MassSpringModel& model, const SpringRows& springs, std::uint32_t count,
                    Groups& groups) {
  if (groups.count >= count) return;
  if (count > model.node_count())
    throw InputError(fmt::format("simplify: {} nodes cannot form {} groups; use at most {}",
                                 model.node_count(), count, model.node_count()));
  std::vector<std::vector<std::uint32_t>> members(groups.count);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) members[groups.of[i]].push_back(i);
  // The largest group first; of equal ones the lowest number.
  std::priority_queue<std::pair<std::size_t, std::int64_t>> largest;
  for (std::uint32_t g = 0; g < groups.count; ++g)
    largest.emplace(members[g].size(), -static_cast<std::int64_t>(g));
  while (groups.count < count) {
    const auto group = static_cast<std::uint32_t>(-largest.top().second);
    largest.pop();
    const std::uint32_t node = last_reached(springs, groups, members[group]);
    members[group].erase(std::find(members[group].begin(), members[group].end(), node));
    groups.of[node] = groups.count++;
    largest.emplace(members[group].size(), -static_cast<std::int64_t>(group));
  }
}

void fuse_to_count(const MassSpringModel& model, BorderRule border, std::uint32_t count,
                   Groups& groups) {
  while (groups.count > count) {
    const Merged merged = merged_nodes(model, groups);
    Groups fewer =
        fuse_pairs(groups, merged, partners(model, groups, merged, border), groups.count - count);
    if (fewer.count == groups.count) return;
    groups = std::move(fewer);
  }
}

}  // namespace springlod::lod
