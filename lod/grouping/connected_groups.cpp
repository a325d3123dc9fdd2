#include "lod/grouping/connected_groups.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"

namespace springlod::lod {
namespace {

/// The connected fragments of each group.
struct Fragments {
  std::vector<std::uint32_t> of;     // fragment of each node
  std::vector<std::uint32_t> group;  // of each fragment
  std::vector<bool> main;            // whether it is the largest of its group
};

Fragments fragments_of(const MassSpringModel& model, const Groups& groups) {
  DisjointSets joined(model.node_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (groups.of[model.a[s]] == groups.of[model.b[s]]) joined.unite(model.a[s], model.b[s]);
  DisjointSets::Numbers numbers = joined.numbers();
  Fragments fragments{std::move(numbers.of), std::vector<std::uint32_t>(numbers.count),
                      std::vector<bool>(numbers.count, false)};
  std::vector<std::uint32_t> size(numbers.count, 0);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    fragments.group[fragments.of[i]] = groups.of[i];
    ++size[fragments.of[i]];
  }
  std::vector<std::uint32_t> largest(groups.count, numbers.count);
  for (std::uint32_t p = 0; p < numbers.count; ++p)
    if (std::uint32_t& best = largest[fragments.group[p]];
        best == numbers.count || size[p] > size[best])
      best = p;
  for (const std::uint32_t p : largest) fragments.main[p] = true;
  return fragments;
}

}  // namespace

void connect_groups(const MassSpringModel& model, Groups& groups) {
  for (;;) {
    const Fragments fragments = fragments_of(model, groups);
    if (std::find(fragments.main.begin(), fragments.main.end(), false) == fragments.main.end())
      return;
    // Number of springs from each smaller fragment to each neighbouring group.
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> springs;
    const auto count = [&](std::uint32_t i, std::uint32_t j) {
      if (!fragments.main[fragments.of[i]] && fragments.main[fragments.of[j]])
        ++springs[{fragments.of[i], groups.of[j]}];
    };
    for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
      count(model.a[s], model.b[s]);
      count(model.b[s], model.a[s]);
    }
    std::vector<std::uint32_t> to = fragments.group;
    std::vector<std::uint32_t> most(to.size(), 0);
    for (const auto& [pair, number] : springs)
      if (number > most[pair.first]) {
        most[pair.first] = number;
        to[pair.first] = pair.second;
      }
    // The fragments left lie in components of the body where no group has its largest fragment.
    if (springs.empty())
      for (std::size_t fragment = 0; fragment < to.size(); ++fragment)
        if (!fragments.main[fragment]) to[fragment] = groups.count++;
    for (std::uint32_t i = 0; i < model.node_count(); ++i) groups.of[i] = to[fragments.of[i]];
  }
}

}  // namespace springlod::lod
