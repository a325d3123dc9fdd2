#include "voxelize/cells/cell_materials.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <set>

#include <fmt/format.h>

#include "base/error.hpp"
#include "voxelize/cells/nearest_surface.hpp"

namespace springlod::voxelize {
namespace {

// "rod, rubber", at most a few of them.
std::string listed(const std::set<std::string>& names) {
  constexpr std::size_t kMost = 20;
  if (names.empty()) return "none";
  if (names.size() <= kMost) return fmt::format("{}", fmt::join(names, ", "));
  const std::vector<std::string> first(names.begin(), std::next(names.begin(), kMost));
  return fmt::format("{} and {} more", fmt::join(first, ", "), names.size() - kMost);
}

// Gives these cells of a solid the material of its nearest triangle.
void assign_nearest(MaterialGrid& grid, const std::vector<std::uint32_t>& places,
                    const TriangleMesh& mesh, const SolidReport& solid,
                    const std::vector<std::uint16_t>& of_part, const CellFrame& frame) {
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> labels;
  for (const std::uint32_t p : solid.parts)
    for (std::uint32_t i = 0; i < mesh.parts[p].triangle_count; ++i) {
      triangles.push_back(mesh.triangles[mesh.parts[p].first_triangle + i]);
      labels.push_back(p);
    }
  std::vector<CellIndex> cells;
  cells.reserve(places.size());
  for (const std::uint32_t c : places) cells.push_back(grid.cells[c]);
  const std::vector<NearestPoint> nearest =
      nearest_surface(frame, cells, mesh.positions, triangles, labels);
  for (std::size_t i = 0; i < places.size(); ++i)
    grid.material[places[i]] = of_part[nearest[i].label];
}

}  // namespace

void assign_part_materials(MaterialGrid& grid, const TriangleMesh& mesh,
                           const std::vector<SolidReport>& solids, const CellFrame& frame,
                           MaterialChoice& materials) {
  std::vector<std::uint16_t> of_part;
  for (const MeshPart& part : mesh.parts) of_part.push_back(materials.of_part(part));
  std::vector<std::uint16_t> of_solid;
  std::vector<std::vector<std::uint32_t>> mixed_cells(
      solids.size());  // of solids of several materials
  std::vector<std::uint8_t> mixed;
  for (const SolidReport& solid : solids) {
    of_solid.push_back(of_part[solid.parts.front()]);
    mixed.push_back(std::any_of(solid.parts.begin(), solid.parts.end(),
                                [&](std::uint32_t p) { return of_part[p] != of_solid.back(); }));
  }
  for (std::uint32_t c = 0; c < grid.cells.size(); ++c) {
    const std::uint16_t s = grid.material[c];
    grid.material[c] = of_solid[s];
    if (mixed[s] != 0) mixed_cells[s].push_back(c);
  }
  for (std::size_t s = 0; s < solids.size(); ++s)
    if (!mixed_cells[s].empty())
      assign_nearest(grid, mixed_cells[s], mesh, solids[s], of_part, frame);
}

bool paint_core(MaterialGrid& grid, double core_depth, MaterialChoice& materials) {
  if (!(core_depth >= 0))
    throw InputError(fmt::format("voxelize: core_depth = {} m; give 0 or more", core_depth));
  bool any = false;
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    if (grid.depth[c] > core_depth) {
      grid.material[c] = materials.of_core();
      any = true;
    }
  return any;
}

void paint_cells(MaterialGrid& grid, const PaintFunction& paint, const CellFrame& frame,
                 MaterialChoice& materials, Progress* progress) {
  Task task(progress, "paint", grid.cells.size());
  for (std::size_t c = 0; c < grid.cells.size(); ++c) {
    const std::string name =
        paint(frame.center(grid.cells[c]), grid.depth[c], materials.name(grid.material[c]));
    if (!name.empty()) grid.material[c] = materials.of_name(name);
    task.advance();
  }
}

std::optional<std::string> unused_materials(const MaterialChoice& materials,
                                            const VoxelizeOptions& options,
                                            const TriangleMesh& mesh) {
  const std::vector<std::string> unused = materials.unused();
  if (unused.empty()) return std::nullopt;
  std::set<std::string> keys;
  for (const auto& [key, input] : options.materials) keys.insert(key);
  std::set<std::string> parts;
  std::set<std::string> of_mesh;
  for (const MeshPart& part : mesh.parts) {
    parts.insert(part.name);
    if (!part.material.empty()) of_mesh.insert(part.material);
  }
  return fmt::format(
      "material{} \"{}\" {} not used: no part or material of the mesh has this name; materials "
      "given: {}; parts of the mesh: {}; its materials: {}",
      unused.size() == 1 ? "" : "s", fmt::join(unused, "\", \""), unused.size() == 1 ? "is" : "are",
      listed(keys), listed(parts), listed(of_mesh));
}

}  // namespace springlod::voxelize
