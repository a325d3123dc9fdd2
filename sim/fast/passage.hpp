#pragma once

#include <cstddef>
#include <cstdint>

#include "model/vec.hpp"

namespace springlod::sim {

/// A point that tunnelled through a wall.
struct Passage {
  std::uint64_t step = 0;    ///< first step at which the point was behind the wall
  std::size_t wall = 0;      ///< number as in TunnelCheck
  std::size_t number = 0;    ///< number as in ContactPoints
  Vec3 from = Vec3::Zero();  ///< [m]
  Vec3 to = Vec3::Zero();    ///< [m]
};

}  // namespace springlod::sim
