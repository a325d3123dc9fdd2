#include "voxelize/lattice/hinges.hpp"

#include <algorithm>

#include "voxelize/cell_material.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

// A hinge at a node, or along the edge from it in the positive direction `axis`.
struct Site {
  std::uint32_t node = 0;
  int axis = -1;  // -1: at the corner
};

struct EdgeOctants {
  std::array<unsigned, 4> octants;  // around the edge; opposite ones are two apart
};

EdgeOctants octants_around_edge(int axis) {
  const unsigned along = 1U << axis;
  const unsigned u = 1U << (axis + 1) % 3;
  const unsigned v = 1U << (axis + 2) % 3;
  return {{along, along | u, along | u | v, along | v}};
}

bool is_edge_hinge(const CornerNodes& nodes, std::uint32_t node, std::uint8_t mask, int axis) {
  const auto octants = octants_around_edge(axis).octants;
  const auto filled = [&](int i) { return (mask >> octants[i] & 1U) != 0; };
  if (filled(0) != filled(2) || filled(1) != filled(3) || filled(0) == filled(1)) return false;
  const unsigned one = octants[filled(0) ? 0 : 1];
  const unsigned other = octants[filled(0) ? 2 : 3];
  const OctantClusters& here = octant_clusters(mask);
  if (here.of[one] != here.of[other]) return true;
  const unsigned along = 1U << axis;
  const std::uint32_t far_node = nodes.of_cell[nodes.around[node][one]][(7 - one) ^ along];
  const OctantClusters& there = octant_clusters(octant_mask(nodes, far_node));
  return there.of[one ^ along] != there.of[other ^ along];
}

std::vector<Site> find_sites(const CornerNodes& nodes) {
  std::vector<Site> sites;
  for (std::uint32_t node = 0; node < nodes.at.size(); ++node) {
    const std::uint8_t mask = octant_mask(nodes, node);
    if (mask == 0xFF) continue;
    if (octant_clusters(mask).corner_contact) sites.push_back({node, -1});
    for (int axis = 0; axis < 3; ++axis)
      if (is_edge_hinge(nodes, node, mask, axis)) sites.push_back({node, axis});
  }
  return sites;
}

CellIndex cell_in_octant(const CellIndex& node, unsigned octant) {
  return {node[0] - 1 + static_cast<std::int32_t>(octant & 1U),
          node[1] - 1 + static_cast<std::int32_t>(octant >> 1U & 1U),
          node[2] - 1 + static_cast<std::int32_t>(octant >> 2U & 1U)};
}

// The empty cells whose filling could connect the two sides by faces.
std::vector<CellIndex> candidates(const CornerNodes& nodes, const Site& site) {
  std::vector<CellIndex> cells;
  const auto& around = nodes.around[site.node];
  const auto take = [&](unsigned octant) {
    cells.push_back(cell_in_octant(nodes.at[site.node], octant));
  };
  if (site.axis >= 0) {
    for (const unsigned o : octants_around_edge(site.axis).octants)
      if (around[o] == kNoIndex) take(o);
    return cells;
  }
  for (unsigned o = 0; o < 8; ++o) {
    const bool touches =
        around[o ^ 1U] != kNoIndex || around[o ^ 2U] != kNoIndex || around[o ^ 4U] != kNoIndex;
    if (around[o] == kNoIndex && touches) take(o);
  }
  return cells;
}

std::vector<std::uint32_t> face_neighbours(const IndexLookup& lookup, const CellIndex& cell) {
  std::vector<std::uint32_t> found;
  for (int d = 0; d < 3; ++d)
    for (const int step : {-1, 1}) {
      CellIndex next = cell;
      next[d] += step;
      if (const std::uint32_t n = lookup.find(next); n != kNoIndex) found.push_back(n);
    }
  return found;
}

struct AddedCell {
  CellIndex cell{};
  std::uint16_t material = 0;
};

// One cell for each hinge; hinges next to a cell that was already chosen are skipped.
std::vector<AddedCell> choose_cells(const MaterialGrid& grid, const CornerNodes& nodes,
                                    const std::vector<Site>& sites) {
  const IndexLookup lookup(grid.cells);
  const auto before = [](const AddedCell& l, const CellIndex& r) { return grid_order(l.cell, r); };
  std::vector<AddedCell> added;  // sorted
  for (const Site& site : sites) {
    const std::vector<CellIndex> choice = candidates(nodes, site);
    const auto place = [&](const CellIndex& cell) {
      return std::lower_bound(added.begin(), added.end(), cell, before);
    };
    const bool changed = std::any_of(choice.begin(), choice.end(), [&](const CellIndex& cell) {
      const auto at = place(cell);
      return at != added.end() && at->cell == cell;
    });
    if (changed) continue;
    CellIndex best{};
    std::vector<std::uint32_t> best_faces;
    for (const CellIndex& cell : choice) {
      std::vector<std::uint32_t> faces = face_neighbours(lookup, cell);
      if (faces.size() > best_faces.size() ||
          (faces.size() == best_faces.size() && grid_order(cell, best))) {
        best = cell;
        best_faces = std::move(faces);
      }
    }
    added.insert(place(best), {best, commonest_material(grid, best_faces)});
  }
  return added;
}

void insert_cells(MaterialGrid& grid, const std::vector<AddedCell>& added) {
  const bool has_depth = !grid.depth.empty();
  MaterialGrid merged = grid;
  merged.cells.clear();
  merged.material.clear();
  merged.depth.clear();
  merged.fraction.clear();
  auto next = added.begin();
  const auto put = [&](const CellIndex& cell, std::uint16_t material, float depth,
                       double fraction) {
    merged.cells.push_back(cell);
    merged.material.push_back(material);
    if (has_depth) merged.depth.push_back(depth);
    if (!grid.fraction.empty()) merged.fraction.push_back(static_cast<float>(fraction));
  };
  const auto fill = [&] { put(next->cell, next->material, 0, 1); };
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    for (; next != added.end() && grid_order(next->cell, grid.cells[n]); ++next) fill();
    put(grid.cells[n], grid.material[n], has_depth ? grid.depth[n] : 0, grid.fraction_of(n));
  }
  for (; next != added.end(); ++next) fill();
  grid = std::move(merged);
}

}  // namespace

std::vector<Hinge> find_hinges(const MaterialGrid& grid, const CornerNodes& nodes) {
  std::vector<Hinge> hinges;
  for (const Site& site : find_sites(nodes)) {
    const CellIndex& at = nodes.at[site.node];
    Vec3 index(at[0], at[1], at[2]);
    if (site.axis >= 0) index[site.axis] += 0.5;
    hinges.push_back({grid.origin + grid.cell * index, site.axis >= 0});
  }
  return hinges;
}

std::uint32_t fill_hinges(MaterialGrid& grid) {
  const std::size_t before = grid.cells.size();
  // Every pass fills at least one cell inside the bounding box, so the loop ends.
  while (true) {
    const CornerNodes nodes = corner_nodes(grid.cells);
    const std::vector<Site> sites = find_sites(nodes);
    if (sites.empty()) break;
    insert_cells(grid, choose_cells(grid, nodes, sites));
  }
  return static_cast<std::uint32_t>(grid.cells.size() - before);
}

}  // namespace springlod::voxelize
