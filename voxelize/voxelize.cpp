#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "model/error.hpp"
#include "voxelize/frame.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/inside.hpp"
#include "voxelize/material_choice.hpp"
#include "voxelize/nearest_surface.hpp"
#include "voxelize/shells.hpp"
#include "voxelize/solid.hpp"

namespace springlod {
namespace {

// Cells along the longest side where no cell is asked for: some thousands of nodes.
constexpr double kDefaultCells = 32;
// Part of its volume by which a solid may change unremarked when it becomes cells.
constexpr double kVolumeTolerance = 0.1;
// A cell of this part of the one asked for shows a solid in which no cell fits; for the message.
constexpr double kFinerCell = 0.25;
// Solids are numbered in 16 bits, 0 is empty.
constexpr std::size_t kMostSolids = 65535;

std::string quoted(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names)
    text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

void require_closed(const std::vector<SolidReport>& solids) {
  if (solids.empty()) throw InputError("voxelize: the mesh has no triangles");
  if (solids.size() > kMostSolids)
    throw InputError(
        fmt::format("voxelize: {} solids, the limit is {}; join some", solids.size(), kMostSolids));
  for (const SolidReport& solid : solids)
    if (!solid.closed())
      throw InputError(fmt::format(
          "voxelize: part \"{}\" is not closed: {} boundary edges, the first at ({:.6g}, {:.6g}, "
          "{:.6g}) m; fill its holes in a mesh editor, it bounds no volume",
          solid.part, solid.boundary_edges, solid.first_hole.x(), solid.first_hole.y(),
          solid.first_hole.z()));
}

// Solids in the order in which they claim cells.
std::vector<std::size_t> claim_order(const TriangleMesh& mesh,
                                     const std::vector<SolidReport>& solids,
                                     const std::vector<std::string>& priority) {
  std::vector<std::size_t> order;
  const auto take = [&](std::size_t s) {
    if (std::find(order.begin(), order.end(), s) == order.end()) order.push_back(s);
  };
  for (const std::string& name : priority) {
    bool found = false;
    for (std::size_t s = 0; s < solids.size(); ++s)
      for (const std::uint32_t p : solids[s].parts)
        if (mesh.parts[p].name == name) {
          take(s);
          found = true;
        }
    if (found) continue;
    std::vector<std::string> names;
    for (const SolidReport& solid : solids) names.push_back(solid.part);
    throw InputError(
        fmt::format("voxelize: priority names \"{}\", but the parts are {}", name, quoted(names)));
  }
  for (std::size_t s = 0; s < solids.size(); ++s) take(s);
  return order;
}

// The work in progress; each member function is one stage.
class Voxelizer {
 public:
  Voxelizer(const TriangleMesh& mesh, const VoxelizeOptions& options)
      : mesh_(mesh), options_(options), materials_(options) {}

  VoxelizedMesh run() {
    validate(mesh_);
    choose_frame();
    solids_ = check_solid(mesh_);
    require_closed(solids_);
    fill_solids();
    gather_cells();
    assign_part_materials();
    measure_depth();
    paint_core();
    paint_function();
    return finish();
  }

 private:
  MaterialGrid& grid() { return result_.grid; }
  VoxelizeReport& report() { return result_.report; }
  void warn(std::string text) { report().warnings.push_back(std::move(text)); }

  void choose_frame() {
    const Box3 box = bounds(mesh_);
    report().cell_chosen = !options_.cell;
    report().cell =
        options_.cell.value_or(box.isEmpty() ? 0 : box.sizes().maxCoeff() / kDefaultCells);
    frame_ = frame_around(box, report().cell);
    owner_.assign(frame_.count(), 0);
  }

  void fill_solids() {
    const std::vector<std::uint32_t> welded = weld_vertices(mesh_);
    Task task(options_.progress, "voxelize", solids_.size());
    for (const std::size_t s : claim_order(mesh_, solids_, options_.priority)) {
      fill_solid(s, sort_shells(mesh_, solids_[s], welded));
      task.advance();
    }
  }

  void fill_solid(std::size_t s, const Shells& shells) {
    const SolidReport& solid = solids_[s];
    if (shells.turned) warn(fmt::format("part \"{}\" was inside out; it was turned", solid.part));
    if (solid.nonmanifold_edges > 0)
      warn(
          fmt::format("part \"{}\" has {} edges where its triangles do not agree; look at the "
                      "result",
                      solid.part, solid.nonmanifold_edges));
    std::shared_ptr<DistanceField> field = level_set(mesh_.positions, shells.outer, frame_);
    if (!shells.cavity.empty())
      subtract(*field, *level_set(mesh_.positions, shells.cavity, frame_));
    const std::vector<std::uint32_t> inside = inside_cells(*field, frame_);
    for (const std::uint32_t n : inside)
      if (owner_[n] == 0) owner_[n] = static_cast<std::uint16_t>(s + 1);
    compare_volume(solid.part, shells.volume, inside.size());
    if (distance_ == nullptr)
      distance_ = std::move(field);
    else
      unite(*distance_, *field);
  }

  void compare_volume(const std::string& part, double mesh_volume, std::size_t cells) {
    report().mesh_volume += mesh_volume;
    const double filled = static_cast<double>(cells) * std::pow(frame_.cell, 3);
    if (cells == 0)
      warn(
          fmt::format("part \"{}\" is lost: no cell of {:.4g} m has its centre in it; use a "
                      "smaller cell",
                      part, frame_.cell));
    else if (std::abs(filled - mesh_volume) > kVolumeTolerance * mesh_volume)
      warn(
          fmt::format("part \"{}\" has {:.4g} m3 in cells against {:.4g} m3 in the mesh "
                      "({:+.0f} %); use a smaller cell or look for crossing surfaces",
                      part, filled, mesh_volume, 100 * (filled / mesh_volume - 1)));
  }

  void gather_cells() {
    for (std::uint32_t n = 0; n < owner_.size(); ++n)
      if (owner_[n] != 0) numbers_.push_back(n);
    if (numbers_.empty())
      throw InputError(
          fmt::format("voxelize: no cell of {:.4g} m has its centre inside the mesh; use a smaller "
                      "cell, say {:.4g} m",
                      frame_.cell, kFinerCell * frame_.cell));
    grid().cell = frame_.cell;
    grid().origin = frame_.origin;
    grid().distance = distance_;
    grid().cells.reserve(numbers_.size());
    for (const std::uint32_t n : numbers_) grid().cells.push_back(frame_.index(n));
  }

  // A solid of one material gives it to all its cells; in a solid of several each cell takes that
  // of the nearest triangle.
  void assign_part_materials() {
    std::vector<std::uint16_t> of_part;
    for (const MeshPart& part : mesh_.parts) of_part.push_back(materials_.of_part(part));
    std::vector<std::vector<std::uint32_t>> cells_of(solids_.size());  // places in grid().cells
    for (std::uint32_t c = 0; c < numbers_.size(); ++c)
      cells_of[owner_[numbers_[c]] - 1U].push_back(c);
    grid().material.resize(numbers_.size());
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      const std::vector<std::uint32_t>& parts = solids_[s].parts;
      const bool uniform = std::all_of(parts.begin(), parts.end(), [&](std::uint32_t p) {
        return of_part[p] == of_part[parts.front()];
      });
      if (!uniform)
        assign_nearest(solids_[s], cells_of[s], of_part);
      else
        for (const std::uint32_t c : cells_of[s]) grid().material[c] = of_part[parts.front()];
    }
  }

  void assign_nearest(const SolidReport& solid, const std::vector<std::uint32_t>& cells,
                      const std::vector<std::uint16_t>& of_part) {
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> labels;
    for (const std::uint32_t p : solid.parts)
      for (std::uint32_t i = 0; i < mesh_.parts[p].triangle_count; ++i) {
        triangles.push_back(mesh_.triangles[mesh_.parts[p].first_triangle + i]);
        labels.push_back(p);
      }
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t c : cells) numbers.push_back(numbers_[c]);
    const std::vector<SurfacePoint> nearest =
        nearest_surface(frame_, numbers, mesh_.positions, triangles, labels);
    for (std::size_t i = 0; i < cells.size(); ++i)
      grid().material[cells[i]] = of_part[nearest[i].label];
  }

  void measure_depth() {
    const std::vector<std::uint32_t> labels(mesh_.triangles.size(), 0);
    const std::vector<SurfacePoint> nearest =
        nearest_surface(frame_, numbers_, mesh_.positions, mesh_.triangles, labels);
    grid().depth.reserve(numbers_.size());
    for (std::size_t c = 0; c < numbers_.size(); ++c) {
      const CellIndex& index = grid().cells[c];
      const Vec3 center(index[0], index[1], index[2]);
      grid().depth.push_back(
          static_cast<float>(frame_.cell * (nearest[c].point.cast<double>() - center).norm()));
    }
  }

  void paint_core() {
    if (!options_.core_shell) return;
    const double core_depth = options_.core_shell->core_depth;
    if (!(core_depth >= 0))
      throw InputError(fmt::format("voxelize: core_depth = {} m; give 0 or more", core_depth));
    bool any = false;
    for (std::size_t c = 0; c < numbers_.size(); ++c)
      if (grid().depth[c] > core_depth) {
        grid().material[c] = materials_.of_core();
        any = true;
      }
    if (!any)
      warn(fmt::format("no cell lies deeper than core_depth = {:.4g} m; there is no core",
                       core_depth));
  }

  void paint_function() {
    if (!options_.paint) return;
    Task task(options_.progress, "paint", numbers_.size());
    for (std::size_t c = 0; c < numbers_.size(); ++c) {
      const std::string name = options_.paint(frame_.center(grid().cells[c]), grid().depth[c],
                                              materials_.name(grid().material[c]));
      if (!name.empty()) grid().material[c] = materials_.of_name(name);
      task.advance();
    }
  }

  VoxelizedMesh finish() {
    for (const std::string& key : materials_.unused())
      warn(fmt::format("material \"{}\" is not used: no part or material of the file has this name",
                       key));
    grid().materials = materials_.finish(grid().material);
    report().grid_volume = static_cast<double>(numbers_.size()) * std::pow(frame_.cell, 3);
    validate(grid());
    return std::move(result_);
  }

  const TriangleMesh& mesh_;
  const VoxelizeOptions& options_;
  MaterialChoice materials_;
  CellFrame frame_;
  std::vector<SolidReport> solids_;
  std::vector<std::uint16_t> owner_;    // solid + 1 of each cell of the frame
  std::vector<std::uint32_t> numbers_;  // of the filled cells
  std::shared_ptr<DistanceField> distance_;
  VoxelizedMesh result_;
};

}  // namespace

VoxelizedMesh voxelize(const TriangleMesh& mesh, const VoxelizeOptions& options) {
  return Voxelizer(mesh, options).run();
}

}  // namespace springlod
