#pragma once

#include "model/vec.hpp"

namespace springlod::sim {

/// Where a body's coordinates are measured from.
struct MovingFrame {
  Vec3 origin = Vec3::Zero();    ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

}  // namespace springlod::sim
