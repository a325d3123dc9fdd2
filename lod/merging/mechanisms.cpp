#include "lod/merging/mechanisms.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "elastic/zero_modes.hpp"
#include "lod/merging/merge.hpp"
#include "lod/merging/rigid_stars.hpp"
#include "lod/merging/rigidity.hpp"

namespace springlod::lod {
namespace {

std::uint32_t mechanisms(const elastic::ComponentModes& part) {
  return part.zero_modes - std::min(part.expected, part.zero_modes);
}

/// Nodes of the merged model that move in mechanisms of components which have more of them than in
/// `fine`.
std::vector<std::uint32_t> folding_nodes(const MassSpringModel& fine, const MassSpringModel& merged,
                                         const Groups& groups) {
  const std::vector<elastic::ComponentModes> parts = elastic::zero_modes(merged);
  if (std::all_of(parts.begin(), parts.end(), [](const auto& p) { return mechanisms(p) == 0; }))
    return {};
  const Components fine_components = connected_components(fine);
  const Components components = connected_components(merged);
  std::vector<std::uint32_t> allowed(components.count, 0);
  const std::vector<elastic::ComponentModes> fine_parts = elastic::zero_modes(fine);
  for (const elastic::ComponentModes& part : fine_parts)
    allowed[components.of_node[groups.of[part.first_node]]] += mechanisms(part);
  std::vector<std::uint32_t> folding;
  for (const elastic::ComponentModes& part : parts)
    if (mechanisms(part) > allowed[components.of_node[part.first_node]])
      folding.insert(folding.end(), part.mechanism_nodes.begin(), part.mechanism_nodes.end());
  return folding;
}

/// The groups of `chosen` taken apart: each of their nodes is a group.
struct Apart {
  Groups groups;
  std::vector<bool> single;  // groups that were part of a chosen one
};

Apart take_apart(const Groups& groups, const std::vector<bool>& chosen) {
  Apart apart;
  apart.groups.of.resize(groups.of.size());
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(groups.count, kNone);
  for (std::size_t i = 0; i < groups.of.size(); ++i) {
    const std::uint32_t g = groups.of[i];
    if (chosen[g] || number[g] == kNone) {
      number[g] = apart.groups.count++;
      apart.single.push_back(chosen[g]);
    }
    apart.groups.of[i] = number[g];
  }
  return apart;
}

/// Fuses nodes of a model pair by pair as long as it stays rigid.
class RigidFusion {
 public:
  RigidFusion(const MassSpringModel& model, std::vector<bool> free, const GuardOptions& options)
      : model_(model),
        free_(std::move(free)),
        options_(options),
        least_distance_(options.coincident_fraction * mean_spring_length(model)),
        stars_(model),
        version_(model.node_count(), 0),
        border_(model.border) {
    sound_.resize(model.node_count());
    for (std::uint32_t i = 0; i < model.node_count(); ++i) sound_[i] = sound(i);
  }

  /// Until there are `count` groups, or no two can be fused.
  Groups run(std::uint32_t count) {
    DisjointSets fused(model_.node_count());
    std::uint32_t left = model_.node_count();
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) offer_links(i, true);
    std::vector<Pair> blocked;
    bool any = false;
    while (left > count) {
      if (waiting_.empty()) {
        if (!any) break;
        any = false;
        for (const Pair& pair : std::exchange(blocked, {}))
          if (current(pair)) waiting_.push(pair);
        continue;
      }
      const Pair pair = waiting_.top();
      waiting_.pop();
      if (!current(pair)) continue;
      if (!try_fuse(pair.low, pair.high)) {
        blocked.push_back(pair);
        continue;
      }
      any = true;
      --left;
      fused.unite(pair.low, pair.high);
      offer_links(pair.low, false);
    }
    DisjointSets::Numbers numbers = fused.numbers();
    return {std::move(numbers.of), numbers.count};
  }

 private:
  struct Pair {
    double loss;  // of the second moment of mass [kg m2]
    std::uint32_t low, high;
    std::uint32_t low_version, high_version;
    bool operator>(const Pair& other) const {
      return std::tie(loss, low, high) > std::tie(other.loss, other.low, other.high);
    }
  };

  bool current(const Pair& pair) const {
    return version_[pair.low] == pair.low_version && version_[pair.high] == pair.high_version;
  }

  bool may_fuse(std::uint32_t i, std::uint32_t j) const {
    if (!free_[i] || !free_[j] || model_.material[i] != model_.material[j]) return false;
    if (options_.border == BorderRule::weak) return border_[i] == border_[j];
    return options_.border == BorderRule::none || (border_[i] == 0 && border_[j] == 0);
  }

  void offer_links(std::uint32_t i, bool only_higher) {
    for (const RigidStars::Link& link : stars_.links(i)) {
      if ((only_higher && link.node < i) || !may_fuse(i, link.node)) continue;
      const double m = stars_.mass(i);
      const double n = stars_.mass(link.node);
      const double loss =
          m * n / (m + n) * (stars_.center(i) - stars_.center(link.node)).squaredNorm();
      const auto [low, high] = std::minmax(i, link.node);
      waiting_.push({loss, low, high, version_[low], version_[high]});
    }
  }

  /// What the guards ask of a node, and a rigid star.
  bool sound(std::uint32_t i) {
    Rigidity node;
    for (const RigidStars::Link& link : stars_.links(i)) {
      const Vec3 d = stars_.center(link.node) - stars_.center(i);
      if (d.norm() < least_distance_) return false;
      node.add_spring(d, link.tension);
    }
    return node.springs() >= options_.least_springs && node.at_least(options_.least_rigidity) &&
           stars_.rigid(i);
  }

  bool try_fuse(std::uint32_t low, std::uint32_t high) {
    RigidStars::Before before = stars_.fuse(low, high);
    bool holds = sound(low);
    for (std::size_t n = 0; holds && n < stars_.links(low).size(); ++n) {
      const std::uint32_t i = stars_.links(low)[n].node;
      holds = !sound_[i] || sound(i);  // what folds in the fine model may fold
    }
    if (!holds) {
      stars_.undo(std::move(before));
      return false;
    }
    sound_[low] = true;
    border_[low] |= border_[high];
    ++version_[low];
    ++version_[high];
    return true;
  }

  const MassSpringModel& model_;
  std::vector<bool> free_;  // nodes that may be fused
  GuardOptions options_;
  double least_distance_;  // [m]
  RigidStars stars_;
  std::vector<std::uint32_t> version_;  // grows when a node is fused
  std::vector<std::uint8_t> border_;
  std::vector<bool> sound_;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<>> waiting_;
};

/// The groups to take apart: those about which others fold, with their neighbours. The hinges of
/// the nodes that move may themselves be at rest. `wider` attempts take what moves, then all.
std::vector<bool> chosen_groups(const MassSpringModel& merged,
                                const std::vector<std::uint32_t>& folding, int wider) {
  std::vector<bool> chosen(merged.node_count(), wider > 1);
  RigidStars stars(merged);
  const auto choose_around = [&](std::uint32_t i) {
    chosen[i] = true;
    for (const RigidStars::Link& link : stars.links(i)) chosen[link.node] = true;
  };
  for (const std::uint32_t i : folding) choose_around(i);
  if (wider > 0) return chosen;
  std::vector<std::uint32_t> hinges;
  for (std::uint32_t i = 0; i < merged.node_count(); ++i)
    if (chosen[i] && !stars.rigid(i)) hinges.push_back(i);
  chosen.assign(merged.node_count(), false);
  for (const std::uint32_t i : hinges) choose_around(i);
  return chosen;
}

}  // namespace

RegroupedStep without_mechanisms(const MassSpringModel& fine, const SpringRows& springs,
                                 GuardedGroups step, std::uint32_t below,
                                 const GuardOptions& options) {
  constexpr int kTries = 4;
  GuardedGroups tried = step;
  std::vector<bool> regrouped(fine.node_count(), false);
  for (int attempt = 0; attempt < kTries; ++attempt) {
    MassSpringModel merged = merge_springs(fine, tried.groups, std::move(tried.links));
    const std::vector<std::uint32_t> folding = folding_nodes(fine, merged, tried.groups);
    if (folding.empty()) {
      if (tried.groups.count >= below) break;
      return {std::move(tried.groups), std::move(merged),
              static_cast<std::uint32_t>(std::count(regrouped.begin(), regrouped.end(), true))};
    }
    const std::vector<bool> chosen = chosen_groups(merged, folding, attempt);
    for (std::uint32_t i = 0; i < fine.node_count(); ++i)
      if (chosen[tried.groups.of[i]]) regrouped[i] = true;
    const Apart apart = take_apart(tried.groups, chosen);
    const MassSpringModel dissolved =
        merge_springs(fine, apart.groups, relink(springs, apart.groups));
    Groups groups =
        compose(apart.groups, RigidFusion(dissolved, apart.single, options).run(step.groups.count));
    Relinking links = relink(springs, groups);
    tried = {std::move(groups), std::move(links)};
  }
  MassSpringModel merged = merge_springs(fine, step.groups, std::move(step.links));
  return {std::move(step.groups), std::move(merged), 0};
}

}  // namespace springlod::lod
