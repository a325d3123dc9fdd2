#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// The P points at which a body touches obstacles: those of its contact surface or, if it has none,
/// its nodes with a contact area.
struct BodySurface {
  Binding of_nodes;                 ///< P rows
  std::vector<std::uint32_t> node;  ///< node with the largest weight, P
  std::vector<Vec3> position;       ///< at rest [m], P
  std::vector<Vec3> normal;         ///< outward unit vectors, or zero; see NodeSurface
  std::vector<double> area;         ///< [m2] > 0, P
  /// Of the body under the point, with what is around it held [N/m], 0 if unknown, P.
  std::vector<double> stiffness;
  /// Of a contact with an obstacle that has no stiffness of its own [N/m], P; eq. 64a and 64b of
  /// docs/method.md.
  std::vector<double> contact;

  std::uint32_t count() const { return static_cast<std::uint32_t>(area.size()); }
};
BodySurface body_surface(const MassSpringModel& model);

}  // namespace springlod::sim
