#include "voxelize/cells/separate.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>

#include "base/disjoint_sets.hpp"
#include "model/point_bins.hpp"
#include "voxelize/bodies.hpp"
#include "voxelize/index_lookup.hpp"
#include "voxelize/mesh/weld.hpp"

namespace springlod::voxelize {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
// A surface that is farther than this from all cells bounds none of them [cells]: between a filled
// and an empty neighbour, the surface is at most the diagonal of a cell from the filled one.
constexpr double kNear = 1.7320508;

// The number of each body in descending order of cells.
std::vector<std::uint32_t> ranks_of(const DisjointSets::Numbers& bodies) {
  std::vector<std::size_t> cells(bodies.count, 0);
  for (const std::uint32_t body : bodies.of) ++cells[body];
  std::vector<std::uint32_t> order(bodies.count);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t l, std::uint32_t r) { return cells[l] > cells[r]; });
  std::vector<std::uint32_t> ranks(bodies.count);
  for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
  return ranks;
}

// Of each triangle the body of the nearest cell; kNone if its whole connected surface is far.
std::vector<std::uint32_t> bodies_of_triangles(const TriangleMesh& mesh, const MaterialGrid& grid,
                                               const std::vector<std::uint32_t>& body_of_cell) {
  std::vector<Vec3> centers;
  Box3 box;
  for (const CellIndex& c : grid.cells) {
    centers.push_back(grid.center(c));
    box.extend(centers.back());
  }
  const PointBins bins(centers, box, grid.cell);
  const std::vector<std::uint32_t> welded = weld_vertices(mesh);
  DisjointSets surfaces(static_cast<std::uint32_t>(mesh.positions.size()));
  for (const Triangle& t : mesh.triangles) {
    surfaces.unite(welded[t[0]], welded[t[1]]);
    surfaces.unite(welded[t[0]], welded[t[2]]);
  }
  std::vector<std::uint32_t> found;
  std::vector<std::uint8_t> near(mesh.positions.size(), 0);  // by the lowest vertex of a surface
  for (const Triangle& t : mesh.triangles) {
    const Vec3 middle = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3;
    const PointBins::Near cell = bins.nearest(middle);
    found.push_back(body_of_cell[cell.point]);
    if (cell.offset.norm() <= kNear * grid.cell) near[surfaces.lowest(welded[t[0]])] = 1;
  }
  for (std::size_t t = 0; t < found.size(); ++t)
    if (near[surfaces.lowest(welded[mesh.triangles[t][0]])] == 0) found[t] = kNone;
  return found;
}

TriangleMesh mesh_of_body(const TriangleMesh& mesh, const std::vector<std::uint32_t>& bodies,
                          std::uint32_t body) {
  TriangleMesh taken;
  std::vector<std::uint32_t> renumbered(mesh.positions.size(), kNone);
  const auto vertex = [&](std::uint32_t v) {
    if (renumbered[v] == kNone) {
      renumbered[v] = static_cast<std::uint32_t>(taken.positions.size());
      taken.positions.push_back(mesh.positions[v]);
    }
    return renumbered[v];
  };
  for (const MeshPart& part : mesh.parts) {
    const auto first = static_cast<std::uint32_t>(taken.triangles.size());
    for (std::uint32_t n = 0; n < part.triangle_count; ++n) {
      const std::uint32_t t = part.first_triangle + n;
      if (bodies[t] != body) continue;
      const Triangle& corners = mesh.triangles[t];
      taken.triangles.push_back({vertex(corners[0]), vertex(corners[1]), vertex(corners[2])});
    }
    const auto count = static_cast<std::uint32_t>(taken.triangles.size()) - first;
    if (count > 0) taken.parts.push_back({part.name, part.material, first, count});
  }
  return taken;
}

// The materials of a grid as inputs; damping is a time where its ratio is not known.
std::vector<MaterialInput> inputs_of(const MaterialGrid& grid) {
  if (!grid.inputs.empty()) return grid.inputs;
  std::vector<MaterialInput> inputs;
  for (const Material& material : grid.materials)
    inputs.push_back({.material = material, .damping_ratio = std::nullopt});
  return inputs;
}

// Gives a body those of the materials of the whole grid that it uses.
void finish_materials(MaterialGrid& body, const std::vector<MaterialInput>& of_whole) {
  std::vector<std::uint16_t> renumbered(of_whole.size(), 0);
  std::vector<std::uint8_t> used(of_whole.size(), 0);
  for (const std::uint16_t material : body.material) used[material] = 1;
  std::vector<MaterialInput> inputs;
  for (std::size_t n = 0; n < used.size(); ++n) {
    if (used[n] == 0) continue;
    renumbered[n] = static_cast<std::uint16_t>(inputs.size());
    inputs.push_back(of_whole[n]);
  }
  for (std::uint16_t& material : body.material) material = renumbered[material];
  set_materials(body, inputs);
}

}  // namespace

std::uint32_t count_bodies(const MaterialGrid& grid) {
  return bodies_of(grid.cells).count;
}

SeparateBodies separate_bodies(const MaterialGrid& grid, const TriangleMesh& mesh) {
  DisjointSets::Numbers bodies = bodies_of(grid.cells);
  const std::vector<std::uint32_t> ranks = ranks_of(bodies);
  for (std::uint32_t& body : bodies.of) body = ranks[body];
  const std::vector<std::uint32_t> of_triangle = bodies_of_triangles(mesh, grid, bodies.of);

  SeparateBodies result;
  result.stray_triangles =
      static_cast<std::uint64_t>(std::count(of_triangle.begin(), of_triangle.end(), kNone));
  result.bodies.resize(bodies.count);
  for (std::uint32_t body = 0; body < bodies.count; ++body) {
    result.bodies[body].grid.cell = grid.cell;
    result.bodies[body].grid.origin = grid.origin;
    result.bodies[body].mesh = mesh_of_body(mesh, of_triangle, body);
  }
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    MaterialGrid& body = result.bodies[bodies.of[n]].grid;
    body.cells.push_back(grid.cells[n]);
    body.material.push_back(grid.material[n]);
    if (!grid.depth.empty()) body.depth.push_back(grid.depth[n]);
    if (!grid.fraction.empty()) body.fraction.push_back(grid.fraction[n]);
  }
  if (!grid.surface.empty()) {
    const IndexLookup lookup(grid.cells);
    for (const SurfacePoint& point : grid.surface)
      result.bodies[bodies.of[lookup.find(point.cell)]].grid.surface.push_back(point);
  }
  const std::vector<MaterialInput> inputs = inputs_of(grid);
  for (GridBody& body : result.bodies) finish_materials(body.grid, inputs);
  return result;
}

}  // namespace springlod::voxelize
