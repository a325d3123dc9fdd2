#include "model/point_bins.hpp"

#include <cassert>
#include <limits>
#include <numeric>

namespace springlod::inline model {
namespace {

// Limits the number of bins: points that fill little of their box get larger bins.
constexpr double kMostBinsPerPoint = 16;
constexpr double kFewBins = 4096;

}  // namespace

PointBins::PointBins(const std::vector<Vec3>& points, const Box3& box, double bin, Edges edges)
    : points_(points), box_(box), edges_(edges) {
  assert(bin > 0 && !box.isEmpty());
  const Vec3 extent = box.sizes();
  const double most = std::max(kFewBins, kMostBinsPerPoint * static_cast<double>(points.size()));
  const auto bins = [&](double edge) {
    double total = 1;
    for (int d = 0; d < 3; ++d) {
      count_[d] = std::max(1, static_cast<int>(std::min(extent[d] / edge, kMostSteps)));
      total *= count_[d];
    }
    return total;
  };
  constexpr double kLarger = 1.25;  // about half as many bins
  while (bins(bin) > most) bin *= kLarger;
  for (int d = 0; d < 3; ++d) size_[d] = extent[d] / count_[d];

  const std::size_t total = number({count_[0] - 1, count_[1] - 1, count_[2] - 1}) + 1;
  start_.assign(total + 1, 0);
  std::vector<std::size_t> bin_at(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    bin_at[i] = number(bin_of(points[i]));
    ++start_[bin_at[i] + 1];
  }
  std::partial_sum(start_.begin(), start_.end(), start_.begin());
  sorted_.resize(points.size());
  std::vector<std::uint32_t> next(start_.begin(), start_.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i)
    sorted_[next[bin_at[i]]++] = static_cast<std::uint32_t>(i);
}

std::array<int, 3> PointBins::bin_of(const Vec3& place) const {
  std::array<int, 3> bin{};
  for (int d = 0; d < 3; ++d) {
    double at = place[d] - box_.min()[d];
    const double extent = box_.sizes()[d];
    if (edges_ == Edges::periodic && extent > 0) at -= extent * std::floor(at / extent);
    const double step = size_[d] > 0 ? std::clamp(at / size_[d], 0.0, count_[d] - 1.0) : 0;
    bin[d] = static_cast<int>(step);
  }
  return bin;
}

Vec3 PointBins::shortest(Vec3 offset) const {
  if (edges_ == Edges::closed) return offset;
  for (int d = 0; d < 3; ++d) {
    const double extent = box_.sizes()[d];
    offset[d] -= extent * std::round(offset[d] / extent);
  }
  return offset;
}

std::size_t PointBins::number(std::array<int, 3> bin) const {
  if (edges_ == Edges::periodic)
    for (int d = 0; d < 3; ++d) bin[d] = (bin[d] % count_[d] + count_[d]) % count_[d];
  const auto nx = static_cast<std::size_t>(count_[0]);
  const auto ny = static_cast<std::size_t>(count_[1]);
  return (static_cast<std::size_t>(bin[2]) * ny + static_cast<std::size_t>(bin[1])) * nx +
         static_cast<std::size_t>(bin[0]);
}

PointBins::Near PointBins::nearest(const Vec3& place) const {
  Near best;
  double best_squared = std::numeric_limits<double>::infinity();
  const std::array<int, 3> at = bin_of(place);
  const int last = *std::max_element(count_.begin(), count_.end());
  const auto inside = [&](int step, int d) {
    return edges_ == Edges::periodic || (at[d] + step >= 0 && at[d] + step < count_[d]);
  };
  const auto look = [&](int x, int y, int z) {
    if (!inside(x, 0) || !inside(y, 1) || !inside(z, 2)) return;
    for_bin({at[0] + x, at[1] + y, at[2] + z}, [&](std::uint32_t point) {
      const Vec3 offset = shortest(place - points_[point]);
      const double squared = offset.squaredNorm();
      if (squared > best_squared || (squared == best_squared && point > best.point)) return;
      best = {point, offset};
      best_squared = squared;
    });
  };
  // Searches shells of bins around the place. All points beyond shell n are at least n bins away.
  for (int shell = 0; shell <= last; ++shell) {
    for (int z = -shell; z <= shell; ++z)
      for (int y = -shell; y <= shell; ++y) {
        const bool face = std::abs(z) == shell || std::abs(y) == shell;
        const int step = face ? 1 : 2 * shell;
        for (int x = -shell; x <= shell; x += std::max(1, step)) look(x, y, z);
      }
    const double cleared = shell * size_.minCoeff();
    if (best_squared <= cleared * cleared) break;
  }
  return best;
}

}  // namespace springlod::inline model
