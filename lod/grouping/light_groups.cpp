#include "lod/grouping/light_groups.hpp"

#include <algorithm>
#include <limits>
#include <optional>

namespace springlod::lod {
namespace {

/// Groups of less than this fraction of the mean mass of their kind are light [1].
constexpr double kLight = 0.5;
constexpr int kRounds = 3;

class GroupMasses {
 public:
  GroupMasses(const MassSpringModel& model, const std::vector<std::uint32_t>& kind, Groups& groups)
      : model_(model),
        kind_(kind),
        groups_(groups),
        mass_(groups.count, 0),
        light_(groups.count, 0),
        size_(groups.count, 0) {
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      mass_[groups.of[i]] += model.mass[i];
      ++size_[groups.of[i]];
    }
    set_light();
  }

  /// False if no group took a node.
  bool feed() {
    const std::vector<std::optional<std::uint32_t>> wanted = nearest_nodes();
    bool fed = false;
    for (std::uint32_t g = 0; g < groups_.count; ++g) {
      if (!wanted[g] || !may_take(g, *wanted[g])) continue;
      take(g, *wanted[g]);
      fed = true;
    }
    return fed;
  }

 private:
  /// The mass below which each group is light.
  void set_light() {
    std::vector<std::uint32_t> kind_of_group(groups_.count, 0);
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) kind_of_group[groups_.of[i]] = kind_[i];
    const std::size_t kinds = 1 + *std::max_element(kind_.begin(), kind_.end());
    std::vector<double> sum(kinds, 0), count(kinds, 0);
    for (std::uint32_t g = 0; g < groups_.count; ++g) {
      sum[kind_of_group[g]] += mass_[g];
      ++count[kind_of_group[g]];
    }
    for (std::uint32_t g = 0; g < groups_.count; ++g)
      light_[g] = kLight * sum[kind_of_group[g]] / count[kind_of_group[g]];
  }

  /// For each light group the nearest node that it may take.
  std::vector<std::optional<std::uint32_t>> nearest_nodes() const {
    const std::vector<Vec3> center = centers();
    std::vector<double> least(groups_.count, std::numeric_limits<double>::infinity());
    std::vector<std::optional<std::uint32_t>> nearest(groups_.count);
    const auto offer = [&](std::uint32_t taker, std::uint32_t node) {
      const std::uint32_t g = groups_.of[taker];
      if (!(mass_[g] < light_[g]) || kind_[taker] != kind_[node] || !may_take(g, node)) return;
      const double distance = (model_.rest[node] - center[g]).squaredNorm();
      if (!(distance < least[g])) return;
      least[g] = distance;
      nearest[g] = node;
    };
    for (std::uint32_t s = 0; s < model_.spring_count(); ++s) {
      offer(model_.a[s], model_.b[s]);
      offer(model_.b[s], model_.a[s]);
    }
    return nearest;
  }

  std::vector<Vec3> centers() const {
    std::vector<Vec3> center(groups_.count, Vec3::Zero());
    for (std::uint32_t i = 0; i < model_.node_count(); ++i)
      center[groups_.of[i]] += model_.mass[i] / mass_[groups_.of[i]] * model_.rest[i];
    return center;
  }

  bool may_take(std::uint32_t g, std::uint32_t node) const {
    const std::uint32_t from = groups_.of[node];
    return from != g && size_[from] > 1 && mass_[from] - model_.mass[node] >= mass_[g];
  }

  void take(std::uint32_t g, std::uint32_t node) {
    const std::uint32_t from = groups_.of[node];
    mass_[from] -= model_.mass[node];
    mass_[g] += model_.mass[node];
    --size_[from];
    ++size_[g];
    groups_.of[node] = g;
  }

  const MassSpringModel& model_;
  const std::vector<std::uint32_t>& kind_;
  Groups& groups_;
  std::vector<double> mass_;         // by group [kg]
  std::vector<double> light_;        // by group: it is light below [kg]
  std::vector<std::uint32_t> size_;  // by group
};

}  // namespace

void feed_light_groups(const MassSpringModel& model, const std::vector<std::uint32_t>& kind,
                       Groups& groups) {
  if (model.node_count() == 0) return;
  GroupMasses masses(model, kind, groups);
  for (int round = 0; round < kRounds && masses.feed(); ++round) {
  }
}

}  // namespace springlod::lod
