#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "model/corners.hpp"
#include "model/mass_spring.hpp"
#include "model/vec.hpp"

namespace springlod::sim {

/// Stands for a corner that does not exist, where corners are stored in groups.
inline constexpr auto kNoCorner = std::numeric_limits<std::uint32_t>::max();

/// The margin of a corner, (J - kCornerResists) travel, is scale V + offset [m]. A missing corner
/// has a margin of infinity.
struct MarginTerms {
  double scale = 0;                                         ///< [1/m2]
  double offset = std::numeric_limits<double>::infinity();  ///< [m]
};

/// The first corner of each node, and the end: corners are sorted by their nodes.
inline std::vector<std::uint32_t> first_corners(const MassSpringModel& model) {
  std::vector<std::uint32_t> first(model.node_count() + 1, 0);
  for (const Corner& corner : model.corners) ++first[corner.node[0] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

inline MarginTerms margin_terms(const Corner& corner, const std::vector<Vec3>& rest) {
  const double travel = corner_travel(corner, rest);
  return {travel / corner_volume(corner, rest), -kCornerResists * travel};
}

/// Largest absolute value of a coordinate in the box [m].
inline double farthest_coordinate(const Box3& box) {
  return box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
}

/// Bound on the error of margins that are computed in Real [m], while no edge of a corner is longer
/// than kCornerStretch times its length at rest. With the unit roundoff u and the largest
/// coordinate R:
/// - positions are within sqrt(3) u R of the node, edges within 2 sqrt(3) u R of theirs: less than
///   6 u R, because a margin changes by at most the displacement of the nodes;
/// - the determinant has an error of up to 6 u times the product of its edges, and the terms of up
///   to 4 u times the margin: together less than 58 u R, as corners have a shape of at least
///   kFlatCorner, which limits the product of the edges, and edges are shorter than 2 sqrt(3) R.
template <class Real>
double margin_rounding(double farthest) {
  constexpr double kRoundings = 64;
  constexpr double kRoundoff = std::numeric_limits<Real>::epsilon() / 2;
  return kRoundings * kRoundoff * farthest;
}

/// Divides the corners of a block into those with a margin below a limit and all others.
template <class Real>
class MarginFilter {
 public:
  MarginFilter(double margin, double rounding, std::vector<std::uint32_t>& below)
      : rounding_(rounding),
        limit_(std::nextafter(static_cast<Real>(margin + rounding),
                              std::numeric_limits<Real>::infinity())),
        below_(&below) {}

  /// Computed margins below this count as below [m].
  Real limit() const { return limit_; }
  /// The corner `number` has this computed margin; not a number counts as below.
  void add(std::uint32_t number, Real margin) {
    if (number == kNoCorner) return;
    if (margin >= limit_)
      add_above(margin);
    else
      below_->push_back(number);
  }
  /// The least computed margin of corners that are not below the limit.
  void add_above(Real margin) { least_ = std::min(least_, margin); }
  /// Least margin of the corners that are not below [m].
  double least() const { return static_cast<double>(least_) - rounding_; }

 private:
  double rounding_;
  Real limit_;
  Real least_ = std::numeric_limits<Real>::infinity();
  std::vector<std::uint32_t>* below_;
};

}  // namespace springlod::sim
