#include "elastic/solver/dissection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace springlod::elastic {
namespace {

/// Regions of at most this many nodes are not cut further. Smaller ones make the dense blocks too
/// small for fast kernels, larger ones store zeros (the time of 8 to 48 differs by a tenth).
constexpr std::size_t kLeafNodes = 24;
/// Positions of the tried planes: fractions of the nodes below them.
constexpr std::array kFractions{0.42, 0.5, 0.58};

using Nodes = std::vector<std::uint32_t>;

struct Cut {
  Eigen::Index axis = 0;
  double place = 0;
  bool from_low = false;  // the separator consists of nodes of the low side
  double cost = 0;
};

class Dissector {
 public:
  Dissector(const std::vector<Vec3>& points, const NodeGraph& graph)
      : points_(points), graph_(graph), side_(points.size(), Side::outside) {}

  Dissection run() {
    Nodes all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    cut_up(std::move(all));
    return std::move(result_);
  }

 private:
  enum class Side : std::uint8_t { outside, low, high };

  /// Returns the roots of the trees it made: several if the region is disconnected.
  std::vector<std::uint32_t> cut_up(Nodes nodes) {
    if (nodes.empty()) return {};
    const std::optional<Cut> cut = nodes.size() > kLeafNodes ? best_cut(nodes) : std::nullopt;
    if (!cut) return {add_supernode(nodes, {})};
    auto [low, high, separator] = apart(nodes, *cut);
    nodes = {};
    std::vector<std::uint32_t> tops = cut_up(std::move(low));
    const std::vector<std::uint32_t> others = cut_up(std::move(high));
    tops.insert(tops.end(), others.begin(), others.end());
    if (separator.empty()) return tops;
    return {add_supernode(separator, tops)};
  }

  std::uint32_t add_supernode(const Nodes& nodes, const std::vector<std::uint32_t>& children) {
    const auto number = static_cast<std::uint32_t>(result_.supernodes.size());
    for (const std::uint32_t child : children) result_.supernodes[child].parent = number;
    Dissection::Supernode supernode;
    supernode.begin = static_cast<std::uint32_t>(result_.order.size());
    result_.order.insert(result_.order.end(), nodes.begin(), nodes.end());
    supernode.end = static_cast<std::uint32_t>(result_.order.size());
    result_.supernodes.push_back(supernode);
    return number;
  }

  /// Nothing if all nodes coincide.
  std::optional<Cut> best_cut(const Nodes& nodes) {
    std::optional<Cut> best;
    std::vector<double> along(nodes.size());
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::optional<double> last;
      for (const double fraction : kFractions) {
        std::transform(nodes.begin(), nodes.end(), along.begin(),
                       [&](std::uint32_t i) { return points_[i][axis]; });
        const auto middle = along.begin() + static_cast<std::ptrdiff_t>(
                                                fraction * static_cast<double>(nodes.size()));
        std::nth_element(along.begin(), middle, along.end());
        if (last == *middle) continue;
        last = *middle;
        if (const auto cut = weigh(nodes, axis, *middle); cut && (!best || cut->cost < best->cost))
          best = cut;
      }
    }
    return best;
  }

  void mark_sides(const Nodes& nodes, Eigen::Index axis, double place) {
    for (const std::uint32_t i : nodes)
      side_[i] = points_[i][axis] < place ? Side::low : Side::high;
  }
  void unmark(const Nodes& nodes) {
    for (const std::uint32_t i : nodes) side_[i] = Side::outside;
  }
  /// Whether a node of the region is coupled to its other side.
  bool crosses(std::uint32_t i) const {
    const Side other = side_[i] == Side::low ? Side::high : Side::low;
    for (std::uint32_t e = graph_.start[i]; e < graph_.start[i + 1]; ++e)
      if (side_[graph_.neighbour[e]] == other) return true;
    return false;
  }

  std::optional<Cut> weigh(const Nodes& nodes, Eigen::Index axis, double place) {
    mark_sides(nodes, axis, place);
    std::size_t low = 0, low_crossing = 0, high_crossing = 0;
    for (const std::uint32_t i : nodes) {
      if (side_[i] == Side::low) ++low;
      if (crosses(i)) ++(side_[i] == Side::low ? low_crossing : high_crossing);
    }
    unmark(nodes);
    if (low == 0) return std::nullopt;
    Cut cut{axis, place, low_crossing < high_crossing, 0};
    // The separator with the fewest nodes is chosen; in a tie, the one with the most equal halves.
    const auto size = static_cast<double>(nodes.size());
    const double left = static_cast<double>(cut.from_low ? low - low_crossing : low) / size;
    const double right =
        static_cast<double>(nodes.size() - low - (cut.from_low ? 0 : high_crossing)) / size;
    cut.cost =
        static_cast<double>(std::min(low_crossing, high_crossing)) * (1 + std::abs(left - right));
    return cut;
  }

  std::array<Nodes, 3> apart(const Nodes& nodes, const Cut& cut) {
    mark_sides(nodes, cut.axis, cut.place);
    std::array<Nodes, 3> sets;
    auto& [low, high, separator] = sets;
    for (const std::uint32_t i : nodes) {
      const bool from_here = (side_[i] == Side::low) == cut.from_low;
      if (from_here && crosses(i))
        separator.push_back(i);
      else
        (side_[i] == Side::low ? low : high).push_back(i);
    }
    unmark(nodes);
    return sets;
  }

  const std::vector<Vec3>& points_;
  const NodeGraph& graph_;
  std::vector<Side> side_;
  Dissection result_;
};

}  // namespace

Dissection dissect(const std::vector<Vec3>& points, const NodeGraph& graph) {
  return Dissector(points, graph).run();
}

}  // namespace springlod::elastic
