#pragma once

#include "model/vec.hpp"

namespace springlod::sim {

/// The reference frame of a body's coordinates.
struct MovingFrame {
  Vec3 origin = Vec3::Zero();    ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

}  // namespace springlod::sim
