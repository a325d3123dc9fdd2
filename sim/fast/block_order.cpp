#include "sim/fast/block_order.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

namespace springlod::sim {
namespace {

// A part of so few points is not sorted further: one or two cache lines of records.
constexpr std::size_t kLeaf = 4;

using Part = std::span<std::uint32_t>;

class Halving {
 public:
  explicit Halving(const std::vector<Vec3>& points) : points_(points) {}

  Box3 box(Part part) const {
    Box3 box;
    for (const std::uint32_t p : part) box.extend(points_[p]);
    return box;
  }

  /// Halves the part recursively. The first halves with at most `most` points are appended to
  /// `blocks`, unless it is null.
  void halve(Part part, std::uint32_t most, std::vector<Part>* blocks) const {
    if (blocks != nullptr && part.size() <= most) {
      blocks->push_back(part);
      blocks = nullptr;
    }
    if (part.size() <= kLeaf) return;
    Eigen::Index axis = 0;
    box(part).sizes().maxCoeff(&axis);
    const std::size_t middle = part.size() / 2;
    std::nth_element(
        part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
        [&](std::uint32_t p, std::uint32_t q) {
          return points_[p][axis] != points_[q][axis] ? points_[p][axis] < points_[q][axis] : p < q;
        });
    halve(part.first(middle), most, blocks);
    halve(part.subspan(middle), most, blocks);
  }

 private:
  const std::vector<Vec3>& points_;
};

}  // namespace

BlockOrder order_in_blocks(const std::vector<Vec3>& points, std::uint32_t most) {
  std::vector<std::uint32_t> halved(points.size());
  std::iota(halved.begin(), halved.end(), 0U);
  const Halving halving(points);
  std::vector<Part> blocks;
  halving.halve(halved, most, &blocks);

  Eigen::Index axis = 0;
  halving.box(halved).sizes().maxCoeff(&axis);
  std::vector<std::pair<double, Part>> along;
  for (const Part block : blocks) along.emplace_back(halving.box(block).center()[axis], block);
  std::stable_sort(along.begin(), along.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  BlockOrder order;
  for (const auto& [center, block] : along) {
    order.first.push_back(static_cast<std::uint32_t>(order.point.size()));
    order.point.insert(order.point.end(), block.begin(), block.end());
  }
  order.first.push_back(static_cast<std::uint32_t>(points.size()));
  return order;
}

}  // namespace springlod::sim
