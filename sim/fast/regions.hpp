#pragma once

#include "model/vec.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

// Regions in world axes in which nodes may touch an obstacle, computed from bounding boxes only.

/// Bounds of a rotated box.
Box3 bounds_of(const SolidBox& box);

/// Bounds of the region within `bounds` that touches the obstacle; may be empty.
Box3 region_touching(const Obstacle& obstacle, const Box3& bounds);

Box3 moved(const Box3& box, const Vec3& displacement);

}  // namespace springlod::sim
