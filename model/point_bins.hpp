#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "model/vec.hpp"

namespace springlod::inline model {

/// Points sorted into the bins of a box, for neighbour searches. Refers to the points, which must
/// outlive it and lie in the box. A periodic box repeats along every axis; offsets are then those
/// of the nearest image.
class PointBins {
 public:
  static constexpr auto kNoPoint = std::numeric_limits<std::uint32_t>::max();
  enum class Edges { closed, periodic };
  /// `bin` is the intended edge of a bin [m]; the distance between neighbouring points is a good
  /// value.
  PointBins(const std::vector<Vec3>& points, const Box3& box, double bin,
            Edges edges = Edges::closed);

  struct Near {
    std::uint32_t point = kNoPoint;  ///< kNoPoint if there are none
    Vec3 offset = Vec3::Zero();      ///< place - point [m]
  };
  /// The nearest point; of equally near points the lowest number.
  Near nearest(const Vec3& place) const;

  /// Calls visit(point, offset) for every point within `radius`; the offset runs from `place` to
  /// the point. In a periodic box `radius` must be below half its edges.
  template <class Visit>
  void within(const Vec3& place, double radius, const Visit& visit) const {
    const std::array<int, 3> reach{steps(0, radius), steps(1, radius), steps(2, radius)};
    const std::array<int, 3> at = bin_of(place);
    std::array<int, 3> low{};
    std::array<int, 3> high{};
    for (int d = 0; d < 3; ++d) {
      low[d] = at[d] - reach[d];
      high[d] = at[d] + reach[d];
      if (edges_ == Edges::closed || high[d] - low[d] >= count_[d]) {
        low[d] = edges_ == Edges::closed ? std::max(0, low[d]) : 0;
        high[d] = edges_ == Edges::closed ? std::min(count_[d] - 1, high[d]) : count_[d] - 1;
      }
    }
    for (int z = low[2]; z <= high[2]; ++z)
      for (int y = low[1]; y <= high[1]; ++y)
        for (int x = low[0]; x <= high[0]; ++x)
          for_bin({x, y, z}, [&](std::uint32_t point) {
            const Vec3 offset = shortest(points_[point] - place);
            if (offset.squaredNorm() <= radius * radius) visit(point, offset);
          });
  }

 private:
  static constexpr double kMostSteps = 1e6;  // bins along an axis: far below the range of int

  int steps(int d, double radius) const {
    return static_cast<int>(std::min(radius / size_[d], kMostSteps)) + 1;
  }
  std::array<int, 3> bin_of(const Vec3& place) const;
  Vec3 shortest(Vec3 offset) const;
  std::size_t number(std::array<int, 3> bin) const;
  template <class Visit>
  void for_bin(std::array<int, 3> bin, const Visit& visit) const {
    const std::size_t n = number(bin);
    for (std::uint32_t i = start_[n]; i < start_[n + 1]; ++i) visit(sorted_[i]);
  }

  const std::vector<Vec3>& points_;
  Box3 box_;
  Edges edges_;
  std::array<int, 3> count_{};
  Vec3 size_ = Vec3::Zero();           // of a bin [m]
  std::vector<std::uint32_t> start_;   // of each bin in sorted_, and the end
  std::vector<std::uint32_t> sorted_;  // points by bin, ascending within each
};

}  // namespace springlod::inline model
