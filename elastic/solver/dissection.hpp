#pragma once

#include <cstdint>
#include <vector>

#include "model/vec.hpp"

namespace springlod::elastic {

/// Coupled nodes, as compressed rows: the neighbours of node i are entries start[i] ..
/// start[i+1]-1. A node is no neighbour of itself.
struct NodeGraph {
  std::vector<std::uint32_t> start;      ///< N + 1
  std::vector<std::uint32_t> neighbour;  ///< each coupling twice
};

/// An order of elimination that keeps Cholesky factors sparse, and its elimination tree.
///
/// Supernodes are consecutive in `order`, children before their parent. A node is coupled only to
/// nodes of its own supernode, of its descendants and of its ancestors.
struct Dissection {
  static constexpr std::uint32_t kNoParent = 0xffffffff;
  struct Supernode {
    std::uint32_t begin = 0, end = 0;  ///< in `order`; never empty
    std::uint32_t parent = kNoParent;  ///< number of a supernode
  };
  std::vector<std::uint32_t> order;  ///< N: node eliminated in step k
  std::vector<Supernode> supernodes;
};

/// Nested dissection by planes normal to the axes (George 1973; by coordinates as in Heath &
/// Raghavan 1995). Of the planes near the median along x, y and z, the one whose separator has the
/// fewest nodes is taken; both sides are then cut in the same way. In a lattice a separator is one
/// layer of nodes, which is optimal. It needs no random numbers and no tuning.
Dissection dissect(const std::vector<Vec3>& points, const NodeGraph& graph);

}  // namespace springlod::elastic
