#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Zero modes of one connected component: the motions that no spring resists.
struct ComponentModes {
  std::uint32_t first_node = 0;  ///< lowest node of the component
  std::uint32_t node_count = 0;
  std::uint32_t anchored = 0;  ///< number of its anchored nodes
  std::uint32_t zero_modes = 0;
  /// Rigid motions of a component of this shape: 6, for nodes in a straight line 5, for a single
  /// node 3, for an anchored component 0.
  std::uint32_t expected = 6;
  /// Nodes that move in a mechanism, the largest motion first. A mechanism is a zero mode that is
  /// not a rigid motion; in an anchored component every zero mode. The largest rigid cluster of the
  /// component is at rest; without such a cluster (no four nodes connected each to each) the rigid
  /// motions are projected out.
  std::vector<std::uint32_t> mechanism_nodes;
};

/// Counts the zero modes of each connected component, in linear theory about rest. They depend on
/// the geometry of the springs and not on their stiffnesses. Clusters that are certainly rigid are
/// found first, and each is treated as one rigid body. Even large models then have few unknowns.
/// The zero modes of the remaining system are counted by Sylvester's law of inertia, and their
/// motions are found by inverse iteration. Anchored nodes are held by springs to the ground, as
/// stiff as the other springs. Throws InputError for an anchored node that the model does not have.
std::vector<ComponentModes> zero_modes(const MassSpringModel& model,
                                       const std::vector<std::uint32_t>& anchored = {});

}  // namespace springlod::elastic
