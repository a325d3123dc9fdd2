#pragma once

#include "model/vec.hpp"

namespace springlod::sim {

/// Origin of a body's coordinates, which moves at constant velocity during a step.
struct MovingFrame {
  Vec3 origin = Vec3::Zero();    ///< [m]
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
};

}  // namespace springlod::sim
