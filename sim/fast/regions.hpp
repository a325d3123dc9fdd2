#pragma once

#include "model/vec.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

// Regions in world axes: what may touch an obstacle, seen without looking at a single node.

/// Bounds of a turned box.
Box3 bounds_of(const SolidBox& box);

/// Bounds of where something within `bounds` touches the obstacle; may be empty.
Box3 region_touching(const Obstacle& obstacle, const Box3& bounds);

Box3 moved(const Box3& box, const Vec3& way);

}  // namespace springlod::sim
