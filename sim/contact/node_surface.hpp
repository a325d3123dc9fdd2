#pragma once

#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// The surface of a body at its nodes, N entries each.
struct NodeSurface {
  /// Unit vector against the mean direction of the node's springs: at the surface, the outward
  /// normal. Zero where the springs have no mean direction.
  std::vector<Vec3> normal;
  /// Stiffness of the node along the normal with its neighbours held [N/m], 0 without a normal: the
  /// inverse of the second factor of eq. 65 of docs/method.md.
  std::vector<double> stiffness;
  /// Stiffness of a contact at the node with an obstacle that has no stiffness of its own [N/m],
  /// 0 without a contact area; eq. 64a of docs/method.md.
  std::vector<double> contact;
};
NodeSurface node_surface(const MassSpringModel& model);

/// Force per contact area and depth that bears the weight of the body while it sinks in by little
/// [N/m3]; 0 for a body without springs.
double bearing_stiffness(const MassSpringModel& model);

}  // namespace springlod::sim
