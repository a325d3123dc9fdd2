#include "lod/grouping/grown_groups.hpp"

#include <cstdint>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/random.hpp"
#include "lod/grouping/grouping_keys.hpp"
#include "lod/grouping/radix_sort.hpp"

namespace springlod::lod {
namespace {

constexpr std::uint32_t kUngrouped = std::numeric_limits<std::uint32_t>::max();

enum class Draw : std::uint64_t { order = 1, size = 2, tie = 3 };

// Random numbers by hashing of the seed and the arguments, independent of the order of evaluation.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : seed_(split_mix(seed)) {}
  std::uint64_t operator()(Draw what, std::uint64_t x) const { return split_mix(state(what, x)); }
  /// State for numbers of two arguments: split_mix(state ^ y) is the number for (x, y).
  std::uint64_t state(Draw what, std::uint64_t x) const {
    return split_mix(split_mix(seed_ ^ static_cast<std::uint64_t>(what)) ^ x);
  }

 private:
  std::uint64_t seed_;
};

// Order by priority, ties at random; without priorities a random order.
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

class Grouper {
 public:
  Grouper(const GroupingTask& task, PairOrder order)
      : Grouper(task, order,
                order == PairOrder::length ? std::vector<double>{} : spring_gradients(task.model)) {
  }

  Groups run() {
    for (std::size_t visit = 0; visit < order_.size(); ++visit) {
      prefetch_after(visit);
      if (free_[order_[visit]]) grow(order_[visit]);
    }
    return groups_from_leaders(leader_);
  }

 private:
  Grouper(const GroupingTask& task, PairOrder order, std::vector<double> gradient)
      : model_(task.model),
        border_(task.options.border),
        chance_(task.options.seed),
        springs_(task.springs),
        order_(visit_order(model_.node_count(),
                           visit_priority(model_, task.options, order, gradient), chance_)),
        keys_(model_, task.options, order, std::move(gradient)),
        free_(model_.node_count(), true),
        leader_(model_.node_count()) {
    std::iota(leader_.begin(), leader_.end(), 0U);
    if (border_ == BorderRule::strong)
      for (std::uint32_t i = 0; i < model_.node_count(); ++i) free_[i] = model_.border[i] == 0;
  }

  // Visits access memory at random; without prefetching, latency would dominate the time.
  void prefetch_after(std::size_t visit) const {
    constexpr std::size_t kAhead = 8;  // prefetch distance of each stage in visits
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
      const std::uint64_t tie = split_mix(chance ^ j);
      if (std::tie(first, second, tie) < std::tie(best.first, best.second, best.tie))
        best = {first, second, tie, j};
    });
    if (best.node != kUngrouped && border_ == BorderRule::weak &&
        model_.border[best.node] != model_.border[i])
      return kUngrouped;
    return best.node;
  }

  // The first node cannot choose itself: no spring joins a node to itself.
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

}  // namespace

Groups standard_groups(const GroupingTask& task) {
  return Grouper(task, PairOrder::length).run();
}

Groups priority_groups(const GroupingTask& task) {
  return Grouper(task, PairOrder::gradient_and_length).run();
}

Groups hard_priority_groups(const GroupingTask& task) {
  return Grouper(task, PairOrder::gradient_first).run();
}

}  // namespace springlod::lod
