#pragma once

#include <cstddef>
#include <cstdint>

#include "model/vec.hpp"

namespace springlod::sim {

/// A point that tunnelled through a box.
struct Passage {
  std::uint64_t step = 0;    ///< number of the step at which it was behind it
  std::size_t wall = 0;      ///< index in TunnelCheck
  std::size_t number = 0;    ///< index in ContactPoints
  Vec3 from = Vec3::Zero();  ///< [m]
  Vec3 to = Vec3::Zero();    ///< [m]
};

}  // namespace springlod::sim
