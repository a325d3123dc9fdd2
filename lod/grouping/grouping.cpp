#include "lod/grouping/grouping.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "base/disjoint_sets.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"
#include "lod/grouping/compact_groups.hpp"
#include "lod/grouping/grouping_keys.hpp"
#include "lod/grouping/grown_groups.hpp"
#include "lod/grouping/metis_groups.hpp"
#include "lod/grouping/radix_sort.hpp"

namespace springlod::lod {
namespace {

/// The table of groupings. A new grouping needs a file with its function, an enumerator and a row.
constexpr GroupingChoice kGroupings[] = {
    {{Grouping::standard, "standard", "nearest neighbours first, nodes in random order"},
     standard_groups},
    {{Grouping::priority_soft, "priority",
      "short springs between nodes of similar material first: key L (1 + 4 g L), where g is the "
      "relative change of E and density per length"},
     priority_groups},
    {{Grouping::priority_hard, "priority_hard",
      "like priority, but sorted by g first and by length second"},
     hard_priority_groups},
    {{Grouping::compact, "compact",
      "round groups of about equal size within one material, straight from the base"},
     compact_groups,
     {.from_base = true}},
    {{Grouping::metis, "metis", "graph partitions that cut few springs, straight from the base"},
     metis_groups,
     {.from_base = true, .follows_border = false}},
};

constexpr std::uint32_t kUngrouped = std::numeric_limits<std::uint32_t>::max();

/// Throws InputError for a group that springs do not connect. `leader`: first node of each node's
/// group.
void require_joined(const MassSpringModel& model, const std::vector<std::uint32_t>& leader) {
  DisjointSets joined(model.node_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (leader[model.a[s]] == leader[model.b[s]]) joined.unite(model.a[s], model.b[s]);
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (joined.lowest(i) != joined.lowest(leader[i]))
      throw InputError(fmt::format(
          "groups: the group of node {} is not connected by springs, so merging it would join "
          "separate bodies; split it",
          script_number(leader[i])));
}

}  // namespace

Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options) {
  return group_nodes(model, SpringRows(model), options);
}

Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options) {
  return choice_of(options.grouping).make({model, springs, 0, options});
}

Groups groups_from_leaders(const std::vector<std::uint32_t>& leader) {
  Groups groups{std::vector<std::uint32_t>(leader.size()), 0};
  std::vector<std::uint32_t> number(leader.size(), kUngrouped);
  for (std::size_t i = 0; i < leader.size(); ++i) {
    std::uint32_t& n = number[leader[i]];
    if (n == kUngrouped) n = groups.count++;
    groups.of[i] = n;
  }
  return groups;
}

Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets) {
  std::vector<std::uint32_t> leader(model.node_count(), kUngrouped);
  for (const std::vector<std::uint32_t>& set : sets) {
    for (const std::uint32_t i : set) {
      if (i >= model.node_count())
        throw InputError(fmt::format("groups: there is no node {}; the model has {} nodes",
                                     script_number(i), model.node_count()));
      if (leader[i] != kUngrouped)
        throw InputError(fmt::format("groups: node {} occurs twice", script_number(i)));
      leader[i] = set[0];
    }
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (leader[i] == kUngrouped) leader[i] = i;
  require_joined(model, leader);
  return groups_from_leaders(leader);
}

ChoiceTable<GroupingChoice> choices(Grouping) {
  return {"grouping", kGroupings};
}

}  // namespace springlod::lod
