#include "lod/grouping/connected_groups.hpp"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"

namespace springlod::lod {
namespace {

/// The connected pieces of each group.
struct Pieces {
  std::vector<std::uint32_t> of;     // piece of each node
  std::vector<std::uint32_t> group;  // of each piece
  std::vector<bool> main;            // the largest of its group
};

Pieces pieces_of(const MassSpringModel& model, const Groups& groups) {
  DisjointSets joined(model.node_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (groups.of[model.a[s]] == groups.of[model.b[s]]) joined.unite(model.a[s], model.b[s]);
  DisjointSets::Numbers numbers = joined.numbers();
  Pieces pieces{std::move(numbers.of), std::vector<std::uint32_t>(numbers.count),
                std::vector<bool>(numbers.count, false)};
  std::vector<std::uint32_t> size(numbers.count, 0);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    pieces.group[pieces.of[i]] = groups.of[i];
    ++size[pieces.of[i]];
  }
  std::vector<std::uint32_t> largest(groups.count, numbers.count);
  for (std::uint32_t p = 0; p < numbers.count; ++p)
    if (std::uint32_t& best = largest[pieces.group[p]];
        best == numbers.count || size[p] > size[best])
      best = p;
  for (const std::uint32_t p : largest) pieces.main[p] = true;
  return pieces;
}

}  // namespace

void connect_groups(const MassSpringModel& model, Groups& groups) {
  for (;;) {
    const Pieces pieces = pieces_of(model, groups);
    if (std::find(pieces.main.begin(), pieces.main.end(), false) == pieces.main.end()) return;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> springs;  // stray, group
    const auto count = [&](std::uint32_t i, std::uint32_t j) {
      if (!pieces.main[pieces.of[i]] && pieces.main[pieces.of[j]])
        ++springs[{pieces.of[i], groups.of[j]}];
    };
    for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
      count(model.a[s], model.b[s]);
      count(model.b[s], model.a[s]);
    }
    std::vector<std::uint32_t> to = pieces.group;
    std::vector<std::uint32_t> most(to.size(), 0);
    for (const auto& [way, number] : springs)
      if (number > most[way.first]) {
        most[way.first] = number;
        to[way.first] = way.second;
      }
    // Strays in a part of the body where no group has its main piece.
    if (springs.empty())
      for (std::size_t piece = 0; piece < to.size(); ++piece)
        if (!pieces.main[piece]) to[piece] = groups.count++;
    for (std::uint32_t i = 0; i < model.node_count(); ++i) groups.of[i] = to[pieces.of[i]];
  }
}

}  // namespace springlod::lod
