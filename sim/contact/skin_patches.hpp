#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// A point of a body's surface, with the group of nodes that it belongs to.
struct SurfacePoint {
  std::uint32_t group = 0;
  Vec3 position = Vec3::Zero();  ///< [m]
  Vec3 normal = Vec3::Zero();    ///< outward, unit length or zero
  double area = 0;               ///< [m2] > 0
};

/// Flat patches of a surface: numbers of points, each in one patch. The points of a patch belong to
/// one group, and their normals and heights differ little from those of its largest point.
/// `spacing`: mean distance of neighbouring points [m]. A level of few nodes resolves no difference
/// between the forces on the points of a patch, so one contact point of their total area is as
/// exact.
std::vector<std::vector<std::uint32_t>> flat_patches(const std::vector<SurfacePoint>& points,
                                                     double spacing);

}  // namespace springlod::sim
