#pragma once

#include <cstdint>
#include <vector>

#include "voxelize/grid.hpp"
#include "voxelize/random_nodes.hpp"

namespace springlod::voxelize {

/// Two nodes, a < b.
struct NodePair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  Vec3 span = Vec3::Zero();  ///< from a to b (in a periodic box: to the nearest image of b) [m]
  double length = 0;         ///< of span [m]
};

/// Of `candidates`, no pair twice, the shortest, so that every node has at least `least` springs
/// and a node `mean` of them on average, each spring counted at both ends; sorted by (a, b). First
/// each node is joined with its `least` nearest, then the shortest pairs left are added, or the
/// longest taken away that both ends can spare, until the number is right.
std::vector<NodePair> select_pairs(std::vector<NodePair> candidates, std::uint32_t nodes,
                                   double mean, std::uint32_t least);

/// select_pairs among all pairs of near nodes that do not reach across empty space: the straight
/// line must run through filled cells, or filled cells near it must lead from one end to the other.
/// So a node in a part too small for `least` has fewer.
std::vector<NodePair> choose_pairs(const MaterialGrid& grid, const RandomNodes& nodes,
                                   const Box3& box, double mean, std::uint32_t least);

}  // namespace springlod::voxelize
