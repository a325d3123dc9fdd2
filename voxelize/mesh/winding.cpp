#include "voxelize/mesh/winding.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/vec.hpp"

namespace springlod::voxelize {
namespace {

// Nodes farther than this multiple of their reach count as one dipole [1].
constexpr double kFar = 4;
// Triangles of a leaf: one takes about as long as a node.
constexpr std::size_t kLeaf = 8;

// Solid angle of a triangle as seen from the origin, over 4 pi (van Oosterom and Strackee 1983,
// "The solid angle of a plane triangle").
double winding_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm();
  const double lb = b.norm();
  const double lc = c.norm();
  const double up = a.dot(b.cross(c));
  const double down = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
  return std::atan2(up, down) / (2 * std::numbers::pi);
}

}  // namespace

WindingNumber::WindingNumber(const std::vector<Vec3>& positions,
                             std::span<const Triangle> triangles) {
  triangles_.reserve(triangles.size());
  for (const Triangle& t : triangles) {
    const Corners corners{positions[t[0]], positions[t[1]], positions[t[2]]};
    if ((corners.b - corners.a).cross(corners.c - corners.a).squaredNorm() > 0)
      triangles_.push_back(corners);
  }
  nodes_.reserve(triangles_.size());
  if (!triangles_.empty()) build(triangles_);
}

void WindingNumber::build(std::span<Corners> part) {
  const std::size_t number = nodes_.size();
  Node node;
  Box3 box;
  double total = 0;
  for (const auto& [a, b, c] : part) {
    const Vec3 area = (b - a).cross(c - a) / 2;
    const double size = area.norm();
    const Vec3 middle = (a + b + c) / 3;
    node.area += area;
    node.center += size * middle;
    total += size;
    box.extend(middle);
  }
  node.center /= total;
  for (const auto& [a, b, c] : part)
    for (const Vec3& corner : {a, b, c})
      node.reach = std::max(node.reach, (corner - node.center).norm());
  node.first = static_cast<std::uint32_t>(part.data() - triangles_.data());
  if (part.size() <= kLeaf) node.count = static_cast<std::uint32_t>(part.size());
  nodes_.push_back(node);
  if (node.count > 0) return;

  Eigen::Index axis = 0;
  box.sizes().maxCoeff(&axis);
  const auto middle = part.begin() + static_cast<std::ptrdiff_t>(part.size() / 2);
  const auto along = [&](const Corners& t) { return t.a[axis] + t.b[axis] + t.c[axis]; };
  // The order of equal ones depends on nothing but the mesh.
  std::nth_element(part.begin(), middle, part.end(),
                   [&](const Corners& l, const Corners& r) { return along(l) < along(r); });
  build({part.begin(), middle});
  nodes_[number].second = static_cast<std::uint32_t>(nodes_.size());
  build({middle, part.end()});
}

double WindingNumber::at(const Vec3& point) const {
  if (nodes_.empty()) return 0;
  double sum = 0;
  // The tree halves its triangles, so it is at most 32 deep.
  std::array<std::uint32_t, 64> left{};
  std::size_t depth = 0;
  left[depth++] = 0;
  while (depth > 0) {
    const std::uint32_t number = left[--depth];
    const Node& node = nodes_[number];
    const Vec3 away = node.center - point;
    const double squared = away.squaredNorm();
    if (squared > kFar * kFar * node.reach * node.reach) {
      sum += node.area.dot(away) / (4 * std::numbers::pi * squared * std::sqrt(squared));
    } else if (node.count > 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) {
        const auto& [a, b, c] = triangles_[node.first + i];
        sum += winding_of(a - point, b - point, c - point);
      }
    } else {
      left[depth++] = node.second;
      left[depth++] = number + 1;
    }
  }
  return sum;
}

}  // namespace springlod::voxelize
