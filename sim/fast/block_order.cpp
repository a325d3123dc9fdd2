#include "sim/fast/block_order.hpp"

#include <algorithm>
#include <numeric>
#include <span>

namespace springlod {
namespace {

// Points that are left in the order they are in: a cache line or two of records.
constexpr std::size_t kLeaf = 4;

class Halving {
 public:
  Halving(const std::vector<Vec3>& points, std::uint32_t most) : points_(points), most_(most) {}

  void halve(std::span<std::uint32_t> part, std::vector<std::uint32_t>* firsts,
             std::uint32_t first) const {
    if (firsts != nullptr && part.size() <= most_) {
      firsts->push_back(first);
      firsts = nullptr;
    }
    if (part.size() <= kLeaf) return;
    Box3 box;
    for (const std::uint32_t p : part) box.extend(points_[p]);
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t middle = part.size() / 2;
    std::nth_element(
        part.begin(), part.begin() + static_cast<std::ptrdiff_t>(middle), part.end(),
        [&](std::uint32_t p, std::uint32_t q) {
          return points_[p][axis] != points_[q][axis] ? points_[p][axis] < points_[q][axis] : p < q;
        });
    halve(part.first(middle), firsts, first);
    halve(part.subspan(middle), firsts, first + static_cast<std::uint32_t>(middle));
  }

 private:
  const std::vector<Vec3>& points_;
  std::uint32_t most_;
};

}  // namespace

BlockOrder order_in_blocks(const std::vector<Vec3>& points, std::uint32_t most) {
  BlockOrder order;
  order.point.resize(points.size());
  std::iota(order.point.begin(), order.point.end(), 0U);
  Halving(points, most).halve(order.point, &order.first, 0);
  order.first.push_back(static_cast<std::uint32_t>(points.size()));
  return order;
}

}  // namespace springlod
