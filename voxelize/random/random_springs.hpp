#pragma once

#include <cstdint>
#include <vector>

#include "voxelize/grid.hpp"
#include "voxelize/random/random_nodes.hpp"

namespace springlod::voxelize {

/// Two nodes, a < b.
struct NodePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  Vec3 span = Vec3::Zero();  ///< from a to b (in a periodic box: to the nearest image of b) [m]
  double length = 0;         ///< of span [m]
};

/// Selects the shortest of `candidates` (each pair once) so that every node has at least `least`
/// springs and a node has `mean` springs on average, counting each spring at both ends. Sorted by
/// (a, b). First each node is connected with its `least` nearest; then the shortest remaining pairs
/// are added, or the longest pairs are removed that neither end needs.
std::vector<NodePair> select_pairs(std::vector<NodePair> candidates, std::uint32_t nodes,
                                   double mean, std::uint32_t least);

/// select_pairs among the pairs of close nodes that the solid connects: the straight line between
/// them runs through filled cells, or a path of filled cells near the line connects its ends. A
/// node in a component too small for `least` has fewer springs.
std::vector<NodePair> choose_pairs(const MaterialGrid& grid, const RandomNodes& nodes,
                                   const Box3& box, double mean, std::uint32_t least);

}  // namespace springlod::voxelize
