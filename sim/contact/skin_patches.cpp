#include "sim/contact/skin_patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace springlod::sim {
namespace {

// Smallest cosine of the angle between the normal of a point and that of its patch [1]: 26 degrees.
// The normal of a point on the edge of a box is 45 degrees from that of the face and 35 degrees
// from that of the corner. Edges and corners so keep points of their own, which touch first when
// the body lands on them; a patch that holds them too has its mean within the face, and touches
// late.
constexpr double kLeastCosine = 0.9;

// Largest height of a point above or below the plane of its patch, over the spacing [1]. The plane
// of the patch then touches an obstacle within a quarter of a cell of where its points would.
constexpr double kMostHeight = 0.25;

}  // namespace

std::vector<std::vector<std::uint32_t>> flat_patches(const std::vector<SurfacePoint>& points,
                                                     double spacing) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) {
    return std::tuple(points[p].group, -points[p].area, p) <
           std::tuple(points[q].group, -points[q].area, q);
  });
  std::vector<std::vector<std::uint32_t>> patches;
  std::size_t first = 0;  // patch of the group
  for (const std::uint32_t p : order) {
    const SurfacePoint& point = points[p];
    if (!patches.empty() && points[patches.back().front()].group != point.group)
      first = patches.size();
    const auto fits = [&](const std::vector<std::uint32_t>& patch) {
      const SurfacePoint& largest = points[patch.front()];
      return largest.normal.dot(point.normal) >= kLeastCosine &&
             std::abs(largest.normal.dot(point.position - largest.position)) <=
                 kMostHeight * spacing;
    };
    const auto patch =
        std::find_if(patches.begin() + static_cast<std::ptrdiff_t>(first), patches.end(), fits);
    if (patch == patches.end())
      patches.push_back({p});
    else
      patch->push_back(p);
  }
  std::sort(patches.begin(), patches.end());
  return patches;
}

}  // namespace springlod::sim
