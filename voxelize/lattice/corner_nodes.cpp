#include "voxelize/lattice/corner_nodes.hpp"

#include <algorithm>

#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

CellIndex corner_of(const CellIndex& cell, unsigned corner) {
  return {cell[0] + static_cast<std::int32_t>(corner & 1U),
          cell[1] + static_cast<std::int32_t>(corner >> 1U & 1U),
          cell[2] + static_cast<std::int32_t>(corner >> 2U & 1U)};
}

std::vector<CellIndex> all_corners(const std::vector<CellIndex>& cells) {
  std::vector<CellIndex> corners;
  corners.reserve(5 * cells.size());
  for (std::size_t n = 0; n < cells.size(); ++n) {
    // The +x corners are the -x corners of the next cell of the row, if it is filled.
    const CellIndex next_in_row{cells[n][0] + 1, cells[n][1], cells[n][2]};
    const bool row_goes_on = n + 1 < cells.size() && cells[n + 1] == next_in_row;
    for (unsigned c = 0; c < 8; ++c)
      if (!row_goes_on || (c & 1U) == 0) corners.push_back(corner_of(cells[n], c));
  }
  std::sort(corners.begin(), corners.end(), grid_order);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

bool has(std::uint8_t mask, unsigned octant) {
  return (mask >> octant & 1U) != 0;
}

// Moves all octants of cluster `from` to cluster `to`.
void join(std::array<std::uint8_t, 8>& of, std::uint8_t from, std::uint8_t to) {
  std::replace(of.begin(), of.end(), from, to);
}

OctantClusters clusters_of(std::uint8_t mask) {
  std::array<std::uint8_t, 8> label{0, 1, 2, 3, 4, 5, 6, 7};
  const auto join_across = [&](unsigned step) {
    for (unsigned o = 0; o < 8; ++o)
      if (has(mask, o) && has(mask, o ^ step) && label[o] != label[o ^ step])
        join(label, std::max(label[o], label[o ^ step]), std::min(label[o], label[o ^ step]));
  };
  const auto count = [&] {
    std::uint8_t n = 0;
    for (unsigned o = 0; o < 8; ++o)
      if (has(mask, o) && label[o] == o) ++n;
    return n;
  };
  for (const unsigned face : {1U, 2U, 4U}) join_across(face);
  OctantClusters clusters;
  // Joining keeps the lower label, so the label of a cluster is its lowest octant.
  for (unsigned o = 0; o < 8; ++o) {
    if (!has(mask, o)) continue;
    clusters.of[o] = label[o] == o ? clusters.count++ : clusters.of[label[o]];
  }
  for (const unsigned edge : {3U, 5U, 6U}) join_across(edge);
  clusters.corner_contact = count() > 1;
  return clusters;
}

}  // namespace

CornerNodes corner_nodes(const std::vector<CellIndex>& cells) {
  CornerNodes nodes;
  nodes.at = all_corners(cells);
  nodes.of_cell.resize(cells.size());
  std::array<std::uint32_t, 8> nobody{};
  nobody.fill(kNoIndex);
  nodes.around.assign(nodes.at.size(), nobody);
  const IndexLookup lookup(nodes.at);
  for (std::size_t n = 0; n < cells.size(); ++n)
    for (unsigned c = 0; c < 8; ++c) {
      const std::uint32_t node = lookup.find(corner_of(cells[n], c));
      nodes.of_cell[n][c] = node;
      nodes.around[node][7 - c] = static_cast<std::uint32_t>(n);
    }
  return nodes;
}

std::uint8_t octant_mask(const CornerNodes& nodes, std::uint32_t node) {
  unsigned mask = 0;
  for (unsigned o = 0; o < 8; ++o)
    if (nodes.around[node][o] != kNoIndex) mask |= 1U << o;
  return static_cast<std::uint8_t>(mask);
}

const OctantClusters& octant_clusters(std::uint8_t mask) {
  static const std::array<OctantClusters, 256> kTable = [] {
    std::array<OctantClusters, 256> table;
    for (unsigned m = 0; m < 256; ++m) table[m] = clusters_of(static_cast<std::uint8_t>(m));
    return table;
  }();
  return kTable[mask];
}

CornerNodes separate_clusters(const CornerNodes& nodes) {
  CornerNodes apart;
  apart.of_cell = nodes.of_cell;
  for (std::uint32_t node = 0; node < nodes.at.size(); ++node) {
    const OctantClusters& clusters = octant_clusters(octant_mask(nodes, node));
    for (std::uint8_t cluster = 0; cluster < clusters.count; ++cluster) {
      const auto copy = static_cast<std::uint32_t>(apart.at.size());
      apart.at.push_back(nodes.at[node]);
      std::array<std::uint32_t, 8>& around = apart.around.emplace_back();
      around.fill(kNoIndex);
      for (unsigned o = 0; o < 8; ++o) {
        const std::uint32_t cell = nodes.around[node][o];
        if (cell == kNoIndex || clusters.of[o] != cluster) continue;
        around[o] = cell;
        apart.of_cell[cell][7 - o] = copy;
      }
    }
  }
  return apart;
}

}  // namespace springlod::voxelize
