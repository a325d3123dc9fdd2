#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The corners of the filled cells as nodes, sorted by (z, y, x). Octants and corners are numbered
/// alike: bit 0 is set on the +x side, bit 1 on +y, bit 2 on +z. For the cell in octant o of a
/// node, the node is its corner 7 - o.
struct CornerNodes {
  std::vector<CellIndex> at;                          ///< N
  std::vector<std::array<std::uint32_t, 8>> around;   ///< N: the cell in each octant or kNoIndex
  std::vector<std::array<std::uint32_t, 8>> of_cell;  ///< node at each corner of each cell
};
CornerNodes corner_nodes(const std::vector<CellIndex>& cells);

/// Mask of the octants around a node: bit o is set if octant o is filled.
std::uint8_t octant_mask(const CornerNodes& nodes, std::uint32_t node);

/// Clusters of filled octants around a node that shared faces connect.
struct OctantClusters {
  std::array<std::uint8_t, 8> of{};  ///< cluster of each filled octant, numbered from the lowest
  std::uint8_t count = 0;
  /// True if several clusters remain when those that share an edge at the node are joined too.
  bool corner_contact = false;
};
const OctantClusters& octant_clusters(std::uint8_t mask);

/// Duplicates each node so that every cluster around it has its own (lowest octant first,
/// consecutive).
CornerNodes separate_clusters(const CornerNodes& nodes);

}  // namespace springlod::voxelize
