#include "lod/grouping.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "model/chance.hpp"
#include "model/error.hpp"

namespace springlod {
namespace {

constexpr std::uint32_t kUngrouped = std::numeric_limits<std::uint32_t>::max();
constexpr double kForbidden = std::numeric_limits<double>::infinity();

// Weight of the gradient against the length in the soft key; the prototype's choice (spec 3).
constexpr double kGradientWeight = 4;

// Keys that differ by less than this part of the mean are equal, and chance decides: on a lattice
// equal lengths differ in their last bits, and rounding must not choose the groups.
constexpr double kTieFraction = 1e-9;

enum class Draw : std::uint64_t { order = 1, size = 2, tie = 3 };

// A random number that depends on nothing but what is asked, so that no order of evaluation can
// change it.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : seed_(mix(seed)) {}
  std::uint64_t operator()(Draw what, std::uint64_t x, std::uint64_t y = 0) const {
    return mix(mix(mix(seed_ ^ static_cast<std::uint64_t>(what)) ^ x) ^ y);
  }

 private:
  std::uint64_t seed_;
};

// A key rounded so that ties are ties, or the forbidden key.
std::vector<double> rounded(std::vector<double> keys) {
  double sum = 0;
  std::size_t count = 0;
  for (const double key : keys)
    if (std::isfinite(key)) {
      sum += std::abs(key);
      ++count;
    }
  const double quantum = count == 0 ? 0 : kTieFraction * sum / static_cast<double>(count);
  for (double& key : keys) {
    if (std::isnan(key)) key = kForbidden;
    if (quantum > 0 && std::isfinite(key)) key = std::round(key / quantum);
  }
  return keys;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

// Young's modulus of a node up to a factor that is the same for all: the mean k weighted by L^2,
// which a node on the border, with fewer springs, does not bias.
std::vector<double> node_stiffness(const MassSpringModel& m) {
  std::vector<double> work(m.node_count(), 0);
  std::vector<double> weight(m.node_count(), 0);
  for (std::uint32_t s = 0; s < m.spring_count(); ++s) {
    const double l2 = m.rest_length[s] * m.rest_length[s];
    for (const std::uint32_t i : {m.a[s], m.b[s]}) {
      work[i] += m.stiffness[s] * l2;
      weight[i] += l2;
    }
  }
  for (std::uint32_t i = 0; i < m.node_count(); ++i)
    work[i] = weight[i] > 0 ? work[i] / weight[i] : 0;
  return work;
}

// g of each spring: |dE| / mean E + |drho| / mean rho per length [1/m] (the paper, section 5.2).
std::vector<double> spring_gradients(const MassSpringModel& m) {
  const std::vector<double> young = node_stiffness(m);
  std::vector<double> density(m.node_count());
  for (std::uint32_t i = 0; i < m.node_count(); ++i) density[i] = m.mass[i] / m.volume[i];
  const double mean_young = mean(young);
  const double mean_density = mean(density);
  std::vector<double> gradient(m.spring_count());
  for (std::uint32_t s = 0; s < m.spring_count(); ++s)
    gradient[s] = (std::abs(young[m.a[s]] - young[m.b[s]]) / mean_young +
                   std::abs(density[m.a[s]] - density[m.b[s]]) / mean_density) /
                  m.rest_length[s];
  return gradient;
}

// What decides between neighbours: first key, then second, then chance.
struct PairKeys {
  std::vector<double> first;
  std::vector<double> second;  // empty: none
};

PairKeys pair_keys(const MassSpringModel& m, const GroupingOptions& options,
                   const std::vector<double>& gradient) {
  if (options.pair_cost) {
    std::vector<double> cost(m.spring_count());
    for (std::uint32_t s = 0; s < m.spring_count(); ++s)
      cost[s] = options.pair_cost(m.a[s], m.b[s]);
    return {rounded(std::move(cost)), {}};
  }
  switch (options.grouping) {
    case Grouping::priority_soft: {
      std::vector<double> key(m.spring_count());
      for (std::uint32_t s = 0; s < m.spring_count(); ++s)
        key[s] = m.rest_length[s] * (1 + kGradientWeight * gradient[s] * m.rest_length[s]);
      return {rounded(std::move(key)), {}};
    }
    case Grouping::priority_hard:
      return {rounded(gradient), rounded(m.rest_length)};
    case Grouping::standard:
      break;
  }
  return {rounded(m.rest_length), {}};
}

std::vector<double> visit_priority(const MassSpringModel& m, const GroupingOptions& options,
                                   const Adjacency& adj, const std::vector<double>& gradient) {
  std::vector<double> priority(m.node_count(), 0);
  if (options.node_priority) {
    for (std::uint32_t i = 0; i < m.node_count(); ++i) priority[i] = options.node_priority(i);
  } else if (options.grouping != Grouping::standard) {
    for (std::uint32_t i = 0; i < m.node_count(); ++i) {
      for (std::uint32_t e = adj.start[i]; e < adj.start[i + 1]; ++e)
        priority[i] += gradient[adj.spring[e]];
      priority[i] /= std::max(1U, adj.start[i + 1] - adj.start[i]);
    }
  }
  return rounded(std::move(priority));
}

std::vector<std::uint32_t> visit_order(const std::vector<double>& priority, const Chance& chance) {
  struct Visit {
    double priority;
    std::uint64_t tie;
    std::uint32_t node;
  };
  std::vector<Visit> visits(priority.size());
  for (std::uint32_t i = 0; i < visits.size(); ++i)
    visits[i] = {priority[i], chance(Draw::order, i), i};
  std::sort(visits.begin(), visits.end(), [](const Visit& x, const Visit& y) {
    if (x.priority != y.priority) return x.priority < y.priority;
    return x.tie != y.tie ? x.tie < y.tie : x.node < y.node;
  });
  std::vector<std::uint32_t> order(visits.size());
  for (std::size_t i = 0; i < visits.size(); ++i) order[i] = visits[i].node;
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
  Grouper(const MassSpringModel& model, const GroupingOptions& options)
      : model_(model),
        border_(options.border),
        chance_(options.seed),
        adj_(adjacency(model)),
        leader_(model.node_count(), kUngrouped) {
    std::vector<double> gradient;
    if (options.grouping != Grouping::standard) gradient = spring_gradients(model);
    keys_ = pair_keys(model, options, gradient);
    order_ = visit_order(visit_priority(model, options, adj_, gradient), chance_);
  }

  Groups run() {
    for (const std::uint32_t i : order_)
      if (leader_[i] == kUngrouped && mergeable(i)) grow(i);
    for (std::uint32_t i = 0; i < model_.node_count(); ++i)
      if (leader_[i] == kUngrouped) leader_[i] = i;
    return numbered(leader_);
  }

 private:
  bool mergeable(std::uint32_t i) const {
    return border_ != BorderRule::strong || model_.border[i] == 0;
  }

  // Nearest free neighbour of the first node by the keys; under a weak border a best candidate of
  // the other kind ends the turn (the paper, section 5.3: no further candidate is tried).
  std::uint32_t candidate(std::uint32_t i) const {
    std::uint32_t best = kUngrouped;
    std::uint32_t best_spring = 0;
    std::uint64_t best_tie = 0;
    for (std::uint32_t e = adj_.start[i]; e < adj_.start[i + 1]; ++e) {
      const std::uint32_t j = adj_.neighbour[e];
      const std::uint32_t s = adj_.spring[e];
      if (leader_[j] != kUngrouped || !mergeable(j) || keys_.first[s] == kForbidden) continue;
      const std::uint64_t tie = chance_(Draw::tie, i, j);
      if (best == kUngrouped || before(s, tie, best_spring, best_tie)) {
        best = j;
        best_spring = s;
        best_tie = tie;
      }
    }
    if (best != kUngrouped && border_ == BorderRule::weak &&
        model_.border[best] != model_.border[i])
      return kUngrouped;
    return best;
  }

  bool before(std::uint32_t s, std::uint64_t s_tie, std::uint32_t t, std::uint64_t t_tie) const {
    if (keys_.first[s] != keys_.first[t]) return keys_.first[s] < keys_.first[t];
    if (!keys_.second.empty() && keys_.second[s] != keys_.second[t])
      return keys_.second[s] < keys_.second[t];
    return s_tie < t_tie;
  }

  void grow(std::uint32_t i) {
    const std::uint32_t size = chance_(Draw::size, i) % 2 == 0 ? 2 : 3;
    const std::uint32_t second = candidate(i);
    if (second == kUngrouped) return;
    leader_[i] = i;
    leader_[second] = i;
    if (size == 2) return;
    const std::uint32_t third = candidate(i);
    if (third != kUngrouped) leader_[third] = i;
  }

  const MassSpringModel& model_;
  BorderRule border_;
  Chance chance_;
  Adjacency adj_;
  PairKeys keys_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> leader_;  // first node of the group
};

void require_joined(const Adjacency& adj, const std::vector<std::uint32_t>& set,
                    const std::vector<std::uint32_t>& leader) {
  std::vector<std::uint32_t> reached{set[0]};
  for (std::size_t next = 0; next < reached.size(); ++next) {
    const std::uint32_t i = reached[next];
    for (std::uint32_t e = adj.start[i]; e < adj.start[i + 1]; ++e) {
      const std::uint32_t j = adj.neighbour[e];
      if (leader[j] == leader[i] && std::find(reached.begin(), reached.end(), j) == reached.end())
        reached.push_back(j);
    }
  }
  if (reached.size() < set.size())
    throw InputError(fmt::format(
        "groups: the group of node {} is not held together by springs; merging it would weld "
        "pieces that are mechanically apart",
        set[0]));
}

}  // namespace

Groups group_nodes(const MassSpringModel& model, const GroupingOptions& options) {
  return Grouper(model, options).run();
}

Groups groups_from_sets(const MassSpringModel& model,
                        const std::vector<std::vector<std::uint32_t>>& sets) {
  std::vector<std::uint32_t> leader(model.node_count(), kUngrouped);
  for (const std::vector<std::uint32_t>& set : sets) {
    for (const std::uint32_t i : set) {
      if (i >= model.node_count())
        throw InputError(
            fmt::format("groups: there is no node {}; the model has {}", i, model.node_count()));
      if (leader[i] != kUngrouped)
        throw InputError(fmt::format("groups: node {} is named twice", i));
      leader[i] = set[0];
    }
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (leader[i] == kUngrouped) leader[i] = i;
  const Adjacency adj = adjacency(model);
  for (const std::vector<std::uint32_t>& set : sets)
    if (!set.empty()) require_joined(adj, set, leader);
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

}  // namespace springlod
