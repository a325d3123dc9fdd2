#pragma once

#include <cstddef>
#include <cstdint>

#include "model/vec.hpp"

namespace springlod::sim {

/// A point that went through a wall.
struct Passage {
  std::uint64_t step = 0;    ///< number of the step at which it was behind it
  std::size_t wall = 0;      ///< as TunnelWatch numbers them
  std::size_t number = 0;    ///< as ContactPoints counts them
  Vec3 from = Vec3::Zero();  ///< [m]
  Vec3 to = Vec3::Zero();    ///< [m]
};

}  // namespace springlod::sim
