#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::sim {

/// How the contacts of a step change a node at its end. Friction kicks a node at the start of the
/// step and so moves it by step * kick. A normal force is constant over the step and moves it by
/// step * kick / 2.
struct NodeChange {
  std::uint32_t node = 0;
  Vec3 displacement = Vec3::Zero();  ///< [m]
  Vec3 kick = Vec3::Zero();          ///< change of the velocity [m/s]

  /// Displacement by friction in a step of length `step` [m].
  Vec3 by_friction(double step) const { return 2 * displacement - step * kick; }
  /// Displacement by normal forces [m].
  Vec3 by_pressure(double step) const { return step * kick - displacement; }
};

}  // namespace springlod::sim
