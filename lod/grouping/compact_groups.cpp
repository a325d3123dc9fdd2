#include "lod/grouping/compact_groups.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/random.hpp"
#include "elastic/stable_step.hpp"
#include "lod/grouping/connected_groups.hpp"
#include "lod/grouping/graded_shares.hpp"
#include "lod/grouping/light_groups.hpp"
#include "model/point_bins.hpp"

namespace springlod::lod {
namespace {

using Nodes = std::vector<std::uint32_t>;

/// Kinds of nodes: nodes of one connected component, material and border flag. A group lies within
/// one kind.
std::vector<Nodes> kinds_of(const MassSpringModel& model, BorderRule border) {
  const Components components = connected_components(model);
  std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, Nodes> kinds;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (border == BorderRule::strong && model.border[i] != 0) continue;
    const bool apart = border == BorderRule::weak && model.border[i] != 0;
    kinds[{components.of_node[i], model.material[i], apart}].push_back(i);
  }
  std::vector<Nodes> nodes;
  for (auto& [kind, of_kind] : kinds) nodes.push_back(std::move(of_kind));
  return nodes;
}

/// The size of each kind and the median of its nodes' bounds on the squared frequency.
std::vector<NodeKind> frequencies_of(const MassSpringModel& model,
                                     const std::vector<Nodes>& kinds) {
  const std::vector<double> bounds = elastic::node_frequency_bounds(model, model.rest);
  std::vector<NodeKind> shared;
  for (const Nodes& kind : kinds) {
    std::vector<double> of_kind;
    for (const std::uint32_t i : kind) of_kind.push_back(bounds[i]);
    const auto median = of_kind.begin() + static_cast<std::ptrdiff_t>(of_kind.size() / 2);
    std::nth_element(of_kind.begin(), median, of_kind.end());
    shared.push_back({static_cast<std::uint32_t>(kind.size()), *median});
  }
  return shared;
}

/// The groups of one kind of nodes.
class CompactKind {
 public:
  CompactKind(const MassSpringModel& model, const Nodes& nodes, std::uint32_t count,
              std::uint64_t seed)
      : model_(model), nodes_(nodes), of_(nodes.size(), 0), center_(count, Vec3::Zero()) {
    RandomStream chance(seed);
    // A lattice has many equal coordinates; the jitter assigns them to a random side of a cut.
    const double jitter = kJitter * bounds_of(nodes).diagonal().norm() / std::cbrt(nodes.size());
    for (const std::uint32_t i : nodes) {
      const Vec3 offset(chance.unit() - 0.5, chance.unit() - 0.5, chance.unit() - 0.5);
      position_.emplace_back(model.rest[i] + jitter * offset);
    }
    Nodes order(nodes.size());
    std::iota(order.begin(), order.end(), 0U);
    std::uint32_t next = 0;
    halve(order, count, next);
  }

  void relax(std::uint32_t passes) {
    if (center_.size() == 1) return;
    for (std::uint32_t pass = 0; pass < passes; ++pass) {
      find_centers();
      if (!assign()) break;
    }
  }

  const std::vector<std::uint32_t>& groups() const { return of_; }

 private:
  /// Jitter of positions, in mean distances of nodes.
  static constexpr double kJitter = 0.6;

  Box3 bounds_of(const Nodes& nodes) const {
    Box3 box;
    for (const std::uint32_t i : nodes) box.extend(model_.rest[i]);
    return box;
  }

  void halve(std::span<std::uint32_t> part, std::uint32_t count, std::uint32_t& next) {
    if (count == 1) {
      for (const std::uint32_t i : part) of_[i] = next;
      ++next;
      return;
    }
    Box3 box;
    for (const std::uint32_t i : part) box.extend(position_[i]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::uint32_t low = count / 2;
    const std::size_t cut = std::clamp<std::size_t>((part.size() * low + count / 2) / count, low,
                                                    part.size() - (count - low));
    std::nth_element(part.begin(), part.begin() + static_cast<std::ptrdiff_t>(cut), part.end(),
                     [&](std::uint32_t p, std::uint32_t q) {
                       const double x = position_[p][axis];
                       const double y = position_[q][axis];
                       return x != y ? x < y : p < q;
                     });
    halve(part.first(cut), low, next);
    halve(part.subspan(cut), count - low, next);
  }

  void find_centers() {
    std::vector<double> mass(center_.size(), 0);
    std::vector<Vec3> sum(center_.size(), Vec3::Zero());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      sum[of_[i]] += model_.mass[nodes_[i]] * model_.rest[nodes_[i]];
      mass[of_[i]] += model_.mass[nodes_[i]];
    }
    for (std::size_t g = 0; g < center_.size(); ++g) center_[g] = sum[g] / mass[g];
  }

  /// Assigns each node to the nearest centre, unless its group would become empty. False if nothing
  /// changed.
  bool assign() {
    Box3 box = bounds_of(nodes_);
    const double bin = std::max(std::cbrt(box.volume() / static_cast<double>(center_.size())),
                                box.diagonal().norm() / static_cast<double>(center_.size() + 1));
    box.min().array() -= bin;
    box.max().array() += bin;
    const PointBins bins(center_, box, bin);
    std::vector<std::uint32_t> size(center_.size(), 0);
    for (const std::uint32_t g : of_) ++size[g];
    bool changed = false;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const std::uint32_t nearest = bins.nearest(model_.rest[nodes_[i]]).point;
      if (nearest == of_[i] || size[of_[i]] == 1) continue;
      --size[of_[i]];
      ++size[nearest];
      of_[i] = nearest;
      changed = true;
    }
    return changed;
  }

  const MassSpringModel& model_;
  const Nodes& nodes_;
  std::vector<Vec3> position_;     // of nodes_, with jitter
  std::vector<std::uint32_t> of_;  // of nodes_
  std::vector<Vec3> center_;
};

}  // namespace

Groups compact_groups(const MassSpringModel& model, const CompactOptions& options) {
  Groups groups{std::vector<std::uint32_t>(model.node_count()), 0};
  if (options.border == BorderRule::strong)
    for (std::uint32_t i = 0; i < model.node_count(); ++i)
      if (model.border[i] != 0) groups.of[i] = groups.count++;
  const std::vector<Nodes> kinds = kinds_of(model, options.border);
  const std::size_t least = groups.count + kinds.size();
  if (options.count < least || options.count > model.node_count())
    throw InputError(fmt::format(
        "compact grouping: {} groups are impossible for {} nodes: {} border nodes stay single "
        "(border = \"strong\"), and the others are of {} kinds (components, materials, weak "
        "borders), which cannot share groups; use {} to {}",
        options.count, model.node_count(), groups.count, kinds.size(), least, model.node_count()));
  const std::vector<std::uint32_t> share =
      graded_shares(frequencies_of(model, kinds), options.count - groups.count, options.grading);
  std::vector<std::uint32_t> kind_of(model.node_count(), static_cast<std::uint32_t>(kinds.size()));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    CompactKind kind(model, kinds[k], share[k], split_mix(options.seed) + k);
    kind.relax(options.passes);
    for (std::size_t i = 0; i < kinds[k].size(); ++i) {
      groups.of[kinds[k][i]] = groups.count + kind.groups()[i];
      kind_of[kinds[k][i]] = static_cast<std::uint32_t>(k);
    }
    groups.count += share[k];
  }
  feed_light_groups(model, kind_of, groups);
  connect_groups(model, groups);
  return groups;
}

Groups compact_groups(const GroupingTask& task) {
  return compact_groups(task.model, {.count = task.count,
                                     .border = task.options.border,
                                     .grading = task.options.grading,
                                     .seed = task.options.seed});
}

}  // namespace springlod::lod
