#include "sim/fast/regions.hpp"

#include <algorithm>

namespace springlod::sim {
namespace {

// Bounds of the part of the box that lies behind the plane.
Box3 part_behind(const Plane& plane, const Box3& box) {
  Vec3 least;  // least value of each term of normal . x
  for (int axis = 0; axis < 3; ++axis)
    least[axis] = plane.normal[axis] * (plane.normal[axis] > 0 ? box.min()[axis] : box.max()[axis]);
  Box3 part = box;
  for (int axis = 0; axis < 3; ++axis) {
    const double normal = plane.normal[axis];
    if (normal == 0) continue;
    const double end = (plane.offset - (least.sum() - least[axis])) / normal;
    if (normal > 0)
      part.max()[axis] = std::min(part.max()[axis], end);
    else
      part.min()[axis] = std::max(part.min()[axis], end);
  }
  return least.sum() < plane.offset ? part : Box3();
}

}  // namespace

Box3 bounds_of(const SolidBox& box) {
  const Vec3 reach = box.rotation.cwiseAbs() * box.half_size;
  return {box.center - reach, box.center + reach};
}

Box3 region_touching(const Obstacle& obstacle, const Box3& bounds) {
  if (const auto* plane = std::get_if<Plane>(&obstacle.shape)) return part_behind(*plane, bounds);
  return bounds_of(std::get<SolidBox>(obstacle.shape)).intersection(bounds);
}

Box3 moved(const Box3& box, const Vec3& displacement) {
  return {box.min() + displacement, box.max() + displacement};
}

}  // namespace springlod::sim
