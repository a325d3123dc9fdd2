#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::elastic {

/// Which nodes are coupled, compressed rows: the neighbours of node i are entries
/// start[i] .. start[i+1]-1. A node is no neighbour of itself.
struct NodeGraph {
  std::vector<std::uint32_t> start;      ///< N + 1
  std::vector<std::uint32_t> neighbour;  ///< each coupling twice
};

/// An order of elimination that keeps Cholesky factors sparse, and the tree that it comes from.
///
/// Pieces are consecutive in `order`, children before their parent. A node is coupled only to nodes
/// of its own piece, of pieces below it in the tree and of pieces above it.
struct Dissection {
  static constexpr std::uint32_t kNoParent = 0xffffffff;
  struct Piece {
    std::uint32_t begin = 0, end = 0;  ///< in `order`; never empty
    std::uint32_t parent = kNoParent;  ///< piece
  };
  std::vector<std::uint32_t> order;  ///< N: the node that is eliminated as number k
  std::vector<Piece> pieces;
};

/// Nested dissection by planes across the axes (George 1973; by coordinates as in Heath & Raghavan
/// 1995): of the planes near the median across x, y and z the one that cuts off with the fewest
/// nodes, then the same on both sides. Of a lattice it takes out one layer of nodes, which is the
/// best there is; it needs no random numbers and no tuning.
Dissection dissect(const std::vector<Vec3>& points, const NodeGraph& graph);

}  // namespace springlod::elastic
