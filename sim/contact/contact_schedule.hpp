#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace springlod::sim {

/// Decides when each point of a body has to be checked against an obstacle. A point at a distance d
/// from the obstacle cannot touch it before the body has travelled d. Far points wait in bins of
/// the travel at which they are due, so that a step costs only what it checks.
class ContactSchedule {
 public:
  /// All points are to be checked at the next step. `bin`: travel per bin [m] > 0. Points nearer
  /// than that are checked at every step.
  void restart(std::uint32_t point_count, double bin);

  /// Calls distance_of(point) for all points to be checked after a total travel of the body [m],
  /// which never decreases. It returns the least travel after which the point may touch the
  /// obstacle [m]; 0 or less: check it at the next step.
  template <class DistanceOf>
  void check(double travel, const DistanceOf& distance_of) {
    advance(travel);
    std::size_t kept = 0;
    for (const std::uint32_t point : near_) {
      const double distance = std::max(0.0, distance_of(point));
      const double bins = std::min((travel + distance) / bin_, kFarthest + now());
      const auto due = static_cast<std::uint64_t>(bins);
      if (due > now_)
        bins_[due % kBins].push_back(point);
      else
        near_[kept++] = point;
    }
    near_.resize(kept);
  }

 private:
  static constexpr std::uint64_t kBins = 512;  // a point farther away is checked after that many
  static constexpr double kFarthest = kBins - 1;

  double now() const { return static_cast<double>(now_); }
  /// Moves the points that are due to near_.
  void advance(double travel);

  double bin_ = 1;         // [m]
  std::uint64_t now_ = 0;  // current bin, counted from the start
  std::vector<std::uint32_t> near_;
  std::vector<std::vector<std::uint32_t>> bins_;
};

}  // namespace springlod::sim
