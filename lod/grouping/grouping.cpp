#include "lod/grouping/grouping.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/chance.hpp"
#include "base/error.hpp"
#include "base/script_number.hpp"
#include "lod/grouping/grouping_keys.hpp"
#include "lod/grouping/radix_sort.hpp"

namespace springlod::lod {
namespace {

constexpr std::uint32_t kUngrouped = std::numeric_limits<std::uint32_t>::max();

enum class Draw : std::uint64_t { order = 1, size = 2, tie = 3 };

// A random number that depends on nothing but what is asked, so that no order of evaluation can
// change it.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : seed_(mix(seed)) {}
  std::uint64_t operator()(Draw what, std::uint64_t x) const { return mix(state(what, x)); }
  /// Mixed with y, the number drawn for (x, y).
  std::uint64_t state(Draw what, std::uint64_t x) const {
    return mix(mix(seed_ ^ static_cast<std::uint64_t>(what)) ^ x);
  }

 private:
  std::uint64_t seed_;
};

// By priority, then by chance; without priorities by chance alone.
std::vector<std::uint32_t> visit_order(std::uint32_t count, const std::vector<double>& priority,
                                       const Chance& chance) {
  std::vector<KeyedNode> visits(count);
  for (std::uint32_t i = 0; i < count; ++i) visits[i] = {chance(Draw::order, i), i};
  radix_sort(visits);
  if (!priority.empty()) {
    const RoundedKeys keys(priority);
    for (KeyedNode& visit : visits) visit.key = radix_key(keys[visit.node]);
    radix_sort(visits);
  }
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = visits[i].node;
  return order;
}

// Groups are numbered by their lowest node: coarse nodes keep the order of the fine ones, which
// keeps neighbours near in memory.
Groups numbered(const std::vector<std::uint32_t>& leader) {
  Groups groups{std::vector<std::uint32_t>(leader.size()), 0};
  std::vector<std::uint32_t> number(leader.size(), kUngrouped);
  for (std::size_t i = 0; i < leader.size(); ++i) {
    std::uint32_t& n = number[leader[i]];
    if (n == kUngrouped) n = groups.count++;
    groups.of[i] = n;
  }
  return groups;
}

class Grouper {
 public:
  Grouper(const MassSpringModel& model, const SpringRows& springs, const GroupingOptions& options)
      : Grouper(model, springs, options,
                options.grouping == Grouping::standard ? std::vector<double>{}
                                                       : spring_gradients(model)) {}

  Groups run() {
    for (std::size_t visit = 0; visit < order_.size(); ++visit) {
      prefetch_after(visit);
      if (free_[order_[visit]]) grow(order_[visit]);
    }
    return numbered(leader_);
  }

 private:
  Grouper(const MassSpringModel& model, const SpringRows& springs, const GroupingOptions& options,
          std::vector<double> gradient)
      : model_(model),
        border_(options.border),
        chance_(options.seed),
        springs_(springs),
        order_(visit_order(model.node_count(), visit_priority(model, options, gradient), chance_)),
        keys_(model, options, std::move(gradient)),
        free_(model.node_count(), true),
        leader_(model.node_count()) {
    std::iota(leader_.begin(), leader_.end(), 0U);
    if (border_ == BorderRule::strong)
      for (std::uint32_t i = 0; i < model.node_count(); ++i) free_[i] = model.border[i] == 0;
  }

  // Visits jump about in memory; without this they would wait for it nearly all the time.
  void prefetch_after(std::size_t visit) const {
    constexpr std::size_t kAhead = 8;  // visits from one stage to the next
    const auto stage = [&](std::size_t ahead, const auto& prefetch) {
      if (visit + ahead < order_.size() && free_[order_[visit + ahead]])
        prefetch(order_[visit + ahead]);
    };
    stage(3 * kAhead, [&](std::uint32_t i) { springs_.prefetch_start(i); });
    stage(2 * kAhead, [&](std::uint32_t i) { springs_.prefetch_row(i); });
    stage(kAhead, [&](std::uint32_t i) {
      springs_.for_each(i, [&](std::uint32_t j, std::uint32_t spring) {
        if (free_[j]) keys_.prefetch(spring);
      });
    });
  }

  // Nearest free neighbour of the first node by the keys; under a weak border a best candidate of
  // the other kind ends the turn (the paper, section 5.3: no further candidate is tried).
  std::uint32_t candidate(std::uint32_t i) const {
    struct Candidate {
      double first = kForbidden;
      double second = 0;
      std::uint64_t tie = 0;
      std::uint32_t node = kUngrouped;
    } best;
    const std::uint64_t chance = chance_.state(Draw::tie, i);
    springs_.for_each(i, [&](std::uint32_t j, std::uint32_t spring) {
      if (!free_[j]) return;
      const double first = keys_.first(spring);
      if (first > best.first || first == kForbidden) return;
      const double second = keys_.second(spring);
      const std::uint64_t tie = mix(chance ^ j);
      if (std::tie(first, second, tie) < std::tie(best.first, best.second, best.tie))
        best = {first, second, tie, j};
    });
    if (best.node != kUngrouped && border_ == BorderRule::weak &&
        model_.border[best.node] != model_.border[i])
      return kUngrouped;
    return best.node;
  }

  // The first node is no candidate of its own: no spring joins a node to itself.
  void grow(std::uint32_t i) {
    const std::uint32_t size = chance_(Draw::size, i) % 2 == 0 ? 2 : 3;
    for (std::uint32_t members = 1; members < size; ++members) {
      const std::uint32_t next = candidate(i);
      if (next == kUngrouped) return;
      free_[i] = free_[next] = false;
      leader_[next] = i;
    }
  }

  const MassSpringModel& model_;
  BorderRule border_;
  Chance chance_;
  const SpringRows& springs_;
  std::vector<std::uint32_t> order_;
  PairKeys keys_;
  std::vector<bool> free_;
  std::vector<std::uint32_t> leader_;  // first node of the group
};

void require_joined(const SpringRows& springs, const std::vector<std::uint32_t>& set,
                    const std::vector<std::uint32_t>& leader) {
  std::vector<std::uint32_t> reached{set[0]};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::uint32_t i = reached[next];
    springs.for_each(i, [&](std::uint32_t j, std::uint32_t) {
      if (leader[j] == leader[i] && std::find(reached.begin(), reached.end(), j) == reached.end())
        reached.push_back(j);
    });
  }
  if (reached.size() < set.size())
    throw InputError(fmt::format(
        "groups: the group of node {} is not held together by springs; merging it would weld "
        "pieces that are mechanically apart",
        script_number(set[0])));
}

}  // namespace

Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options) {
  return group_nodes(model, SpringRows(model), options);
}

Groups group_nodes(const MassSpringModel& model, const SpringRows& springs,
                   const GroupingOptions& options) {
  return Grouper(model, springs, options).run();
}

Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets) {
  std::vector<std::uint32_t> leader(model.node_count(), kUngrouped);
  for (const std::vector<std::uint32_t>& set : sets) {
    for (const std::uint32_t i : set) {
      if (i >= model.node_count())
        throw InputError(fmt::format("groups: there is no node {}; the model has {}",
                                     script_number(i), model.node_count()));
      if (leader[i] != kUngrouped)
        throw InputError(fmt::format("groups: node {} is named twice", script_number(i)));
      leader[i] = set[0];
    }
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (leader[i] == kUngrouped) leader[i] = i;
  const SpringRows springs(model);
  for (const std::vector<std::uint32_t>& set : sets)
    if (!set.empty()) require_joined(springs, set, leader);
  return numbered(leader);
}

std::string to_string(Grouping grouping) {
  switch (grouping) {
    case Grouping::standard:
      return "standard";
    case Grouping::priority_soft:
      return "priority";
    case Grouping::priority_hard:
      return "priority_hard";
    case Grouping::compact:
      return "compact";
    case Grouping::metis:
      return "metis";
  }
  return "?";
}

std::string to_string(BorderRule border) {
  switch (border) {
    case BorderRule::none:
      return "none";
    case BorderRule::weak:
      return "weak";
    case BorderRule::strong:
      return "strong";
  }
  return "?";
}

}  // namespace springlod::lod
