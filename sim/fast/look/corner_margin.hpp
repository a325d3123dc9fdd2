#pragma once

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

/// corner_margin() is kMarginPart room / growth, with room = scale V + offset [m] and growth =
/// |scale| Q [1], the growth of Q since rest. So a group of corners has at least the margin
/// kMarginPart (least room) / (largest growth). A missing corner has more room than any other, and
/// no growth.
struct MarginTerms {
  double scale = 0;                                   ///< 1 / Q at rest [1/m2]
  double offset = std::numeric_limits<float>::max();  ///< -kCornerResists scale V at rest [m]
};

/// The first corner of each node, and the end: corners are sorted by their nodes.
inline std::vector<std::uint32_t> first_corners(const MassSpringModel& model) {
  std::vector<std::uint32_t> first(model.node_count() + 1, 0);
  for (const Corner& corner : model.corners) ++first[corner.node[0] + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  return first;
}

inline MarginTerms margin_terms(const Corner& corner, const std::vector<Vec3>& rest) {
  const double scale = 1 / corner_squares(corner, rest);
  return {scale, -kCornerResists * scale * corner_volume(corner, rest)};
}

/// Bound on the error of room / growth that is computed in Real, over the largest coordinate R of a
/// node [1]. With the unit roundoff u:
/// - positions are within sqrt(3) u R of the node, edges within 2 sqrt(3) u R of theirs. A
///   displacement d of the nodes changes room / growth by up to 2 d: less than 11 u R;
/// - the determinant has an error of up to 7 u times the product of its edges, and the other terms
///   of up to 6 u times the room: together less than 16 u R, because an edge is shorter than
///   2 sqrt(3) R and the product of three at most (Q / 3)^(3/2).
/// The rest covers the rounding of the margin itself, which is computed from them.
template <class Real>
inline constexpr Real kMarginRounding = 64 * std::numeric_limits<Real>::epsilon() / 2;

}  // namespace springlod::sim
