#pragma once

#include "model/vec.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

// Bounding boxes in world axes, to tell whether a block may touch an obstacle without visiting
// nodes.

/// Bounding box of a rotated box.
Box3 bounds_of(const SolidBox& box);

/// Bounding box of the part of `bounds` that is inside the obstacle; may be empty.
Box3 region_touching(const Obstacle& obstacle, const Box3& bounds);

Box3 moved(const Box3& box, const Vec3& displacement);

}  // namespace springlod::sim
