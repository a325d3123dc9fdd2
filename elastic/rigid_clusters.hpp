#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

inline constexpr std::uint32_t kNoCluster = std::numeric_limits<std::uint32_t>::max();

/// Rigid clusters of nodes: a tetrahedron of springs, extended by every node with springs to the
/// cluster in three independent directions. Other rigid sets of nodes exist and are not found.
struct RigidClusters {
  std::vector<std::uint32_t> of_node;  ///< N: number of the cluster, or kNoCluster
  std::uint32_t count = 0;
};
RigidClusters rigid_clusters(const MassSpringModel& model);

}  // namespace springlod::elastic
