#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The corners of the filled cells as nodes, sorted by (z, y, x). An octant or corner number has
/// bit 0 set on the +x side, bit 1 on +y, bit 2 on +z; seen from the cell in octant o of a node,
/// the node is its corner 7 - o.
struct CornerNodes {
  std::vector<CellIndex> at;                          ///< N
  std::vector<std::array<std::uint32_t, 8>> around;   ///< N: the cell in each octant or kNoIndex
  std::vector<std::array<std::uint32_t, 8>> of_cell;  ///< node at each corner of a cell
};
CornerNodes corner_nodes(const std::vector<CellIndex>& cells);

/// Bit o set: octant o of node `node` is filled.
std::uint8_t octant_mask(const CornerNodes& nodes, std::uint32_t node);

/// How the filled octants around a node hang together through faces between them.
struct OctantClusters {
  std::array<std::uint8_t, 8> of{};  ///< cluster of each filled octant, numbered from the lowest
  std::uint8_t count = 0;
  /// True if clusters remain apart even when those that share an edge at the node are joined.
  bool corner_contact = false;
};
const OctantClusters& octant_clusters(std::uint8_t mask);

/// Gives each cluster around a node a node of its own (lowest octant first, one after the other).
CornerNodes separate_clusters(const CornerNodes& nodes);

}  // namespace springlod::voxelize
