#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "base/error.hpp"
#include "base/message.hpp"
#include "base/units.hpp"
#include "voxelize/bodies.hpp"
#include "voxelize/cells/cell_materials.hpp"
#include "voxelize/cells/claim_order.hpp"
#include "voxelize/cells/cut_cells.hpp"
#include "voxelize/cells/depth.hpp"
#include "voxelize/cells/fractions.hpp"
#include "voxelize/cells/frame.hpp"
#include "voxelize/cells/inside.hpp"
#include "voxelize/cells/material_choice.hpp"
#include "voxelize/cells/resolution.hpp"
#include "voxelize/cells/slivers.hpp"
#include "voxelize/cells/solid_field.hpp"
#include "voxelize/cells/surface_points.hpp"
#include "voxelize/enough_memory.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/repair.hpp"
#include "voxelize/mesh/shells.hpp"
#include "voxelize/mesh/solid.hpp"
#include "voxelize/mesh/weld.hpp"

namespace springlod::voxelize {
namespace {

// Default number of cells along the longest side: some thousand nodes.
constexpr double kDefaultCells = 32;
// Factor on the cell that is proposed if no cell is filled.
constexpr double kFinerCell = 0.25;
// Memory per filled cell [bytes]: its index, material and body, and the lists that make them.
constexpr double kBytesPerCell = 60;
// Memory per cell that the surface crosses [bytes]: the narrow band, and what OpenVDB needs to make
// it. Of a needle of 3 x 3 cells.
constexpr double kBytesPerSurfaceCell = 1200;
// Solids have 16-bit numbers; 0 is empty.
constexpr std::size_t kMostSolids = 65535;

void require_solids(const std::vector<SolidReport>& solids) {
  if (solids.empty()) throw InputError("voxelize: the mesh has no triangles");
  if (solids.size() > kMostSolids)
    throw InputError(fmt::format("voxelize: the mesh has {} solids, the limit is {}; join some",
                                 solids.size(), kMostSolids));
}

void require_closed(const std::vector<SolidReport>& solids) {
  for (const SolidReport& solid : solids)
    if (!solid.closed())
      throw InputError(fmt::format(
          "voxelize: part \"{}\" is not closed: it has {} boundary edges, the first at ({:.6g}, "
          "{:.6g}, {:.6g}) m; repair = \"auto\" closes holes",
          solid.part, solid.boundary_edges, solid.first_hole.x(), solid.first_hole.y(),
          solid.first_hole.z()));
}

// The state of a voxelization; each member function is one stage.
class Voxelizer {
 public:
  Voxelizer(const TriangleMesh& mesh, const VoxelizeOptions& options)
      : given_(mesh), options_(options), materials_(options) {}

  VoxelizedMesh run() {
    tbb::task_arena threads(options_.threads == 0 ? tbb::task_arena::automatic
                                                  : static_cast<int>(options_.threads));
    threads.execute([&] { fill(); });
    paint();
    return finish();
  }

 private:
  using Field = std::shared_ptr<DistanceField>;

  const TriangleMesh& mesh() const { return result_.repaired ? *result_.repaired : given_; }
  MaterialGrid& grid() { return result_.grid; }
  VoxelizeReport& report() { return result_.report; }
  void warn(std::string text) { report().warnings.push_back(std::move(text)); }

  void fill() {
    validate(mesh());
    choose_frame();
    const std::vector<std::uint32_t> welded = weld_vertices(mesh());
    solids_ = check_solid(mesh(), welded);
    require_solids(solids_);
    mend(welded);
    require_memory_for_cells();
    fill_solids(sort_shells(mesh(), solids_, welded));
    gather_cells();
    report_slivers();
    assign_part_materials(grid(), mesh(), solids_, frame_, materials_);
    count_bodies();
    if (options_.core_shell || options_.paint) grid().depth = measure_depth(grid(), mesh());
  }

  void mend(const std::vector<std::uint32_t>& welded) {
    if (options_.repair == Repair::off) return require_closed(solids_);
    if (std::all_of(solids_.begin(), solids_.end(), [](const auto& s) { return s.faultless(); }))
      return;
    RepairedMesh repaired = repair(mesh(), solids_, welded);
    std::vector<std::string> faults;
    for (const SolidRepair& solid : repaired.solids)
      for (std::string& line : describe(solid)) faults.push_back(std::move(line));
    if (!faults.empty() && options_.repair == Repair::strict)
      throw InputError(
          fmt::format("voxelize: the mesh needs repair (repair = \"auto\" does this): {}",
                      fmt::join(faults, "; ")));
    report().repairs = std::move(faults);
    result_.repaired = std::move(repaired.mesh);
    for (std::size_t s = 0; s < solids_.size(); ++s) {
      solids_[s].boundary_edges = repaired.solids[s].open_edges;
      solids_[s].nonmanifold_edges = repaired.solids[s].crossing_edges;
      solids_[s].volume = repaired.solids[s].volume;
    }
    std::erase_if(solids_, [&](const SolidReport& solid) {  // of triangles without area
      return std::all_of(solid.parts.begin(), solid.parts.end(),
                         [&](std::uint32_t p) { return mesh().parts[p].triangle_count == 0; });
    });
    require_solids(solids_);
  }

  void choose_frame() {
    const Box3 box = bounds(mesh());
    report().cell_chosen = !options_.cell;
    report().cell =
        options_.cell.value_or(box.isEmpty() ? 0 : box.sizes().maxCoeff() / kDefaultCells);
    frame_ = frame_around(box, report().cell);
    // A box of whole cells stays one; other surfaces may cut cells beyond it.
    if (options_.cut_cells) frame_ = padded(frame_);
    owner_.assign(frame_.count(), 0);
    if (options_.cut_cells) cut_cells_.emplace(frame_);
  }

  void require_memory_for_cells() const {
    double volume = 0;
    for (const SolidReport& solid : solids_) volume += std::abs(solid.volume);
    const double filled = volume / std::pow(frame_.cell, 3);
    const double touched = surface_area(mesh()) / std::pow(frame_.cell, 2);
    if (!(filled > 0)) return;
    const auto all = static_cast<double>(frame_.count());
    // Half cells make four times the surface cells.
    const double of_frame = sizeof(owner_[0]) + (options_.cut_cells ? kBytesPerCutCell : 0);
    const double per_surface = (options_.cut_cells ? 5 : 1) * kBytesPerSurfaceCell;
    const double bytes = of_frame * all + kBytesPerCell * filled + per_surface * touched +
                         (options_.for_lattice ? kLatticeBytesPerNode * filled : 0);
    require_memory_of_cells("voxelize", filled, bytes / filled, frame_.cell);
  }

  // The level sets of as many solids as there are threads are made at once. The solids then claim
  // their cells in sequence, so the number of threads does not change the result.
  void fill_solids(const std::vector<Shells>& shells) {
    const std::vector<std::size_t> order = claim_order(mesh(), solids_, options_.priority);
    const std::vector<Vec3> positions = positions_in(frame_);
    const CellFrame halves = halved(frame_);
    const std::vector<Vec3> in_halves =
        options_.cut_cells ? positions_in(halves) : std::vector<Vec3>();
    Task task(options_.progress, "voxelize", solids_.size());
    std::size_t next = 0;
    const auto choose = [&](tbb::flow_control& control) -> std::size_t {
      if (next < order.size()) return order[next++];
      control.stop();
      return 0;
    };
    // Kept here, because a pipeline that ends with an exception leaks what its filters hand on.
    std::vector<SolidField> fields(shells.size());
    std::vector<SolidField> fine_fields(shells.size());
    const auto make_field = [&](std::size_t s) {
      fields[s] = field_of(solids_[s], shells[s], positions, frame_);
      if (options_.cut_cells) fine_fields[s] = field_of(solids_[s], shells[s], in_halves, halves);
      return s;
    };
    const auto claim = [&](std::size_t s) {
      fill_solid(s, shells[s], std::move(fields[s]), std::move(fine_fields[s]).distance);
      task.advance();
    };
    using tbb::filter_mode;
    tbb::parallel_pipeline(
        static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
        tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, choose) &
            tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, make_field) &
            tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, claim));
  }

  std::vector<Vec3> positions_in(const CellFrame& frame) const {
    std::vector<Vec3> positions;
    positions.reserve(mesh().positions.size());
    for (const Vec3& p : mesh().positions) positions.push_back(frame.to_index(p));
    return positions;
  }

  // OpenVDB leaks memory if its tasks are cancelled. In a context of their own, they end normally
  // after an interrupt or the failure of another part.
  static SolidField field_of(const SolidReport& solid, const Shells& shells,
                             const std::vector<Vec3>& positions, const CellFrame& frame) {
    SolidField field;
    tbb::task_group_context own(tbb::task_group_context::isolated);
    tbb::task_group(own).run_and_wait([&] {
      field = solid.closed() ? closed_field(shells, positions, frame)
                             : open_field(shells, positions, frame);
    });
    return field;
  }

  // `halves`: the level set in half cells, for cut cells; else null.
  void fill_solid(std::size_t s, const Shells& shells, SolidField field, const Field& halves) {
    const SolidReport& solid = solids_[s];
    if (shells.turned && solid.closed())
      warn(fmt::format("part \"{}\" faced inwards; its triangles were reversed", solid.part));
    if (solid.nonmanifold_edges > 0 && options_.repair == Repair::off)
      warn(
          fmt::format("part \"{}\" has {} non-manifold or inconsistently oriented edges; check the "
                      "result",
                      solid.part, solid.nonmanifold_edges));
    const auto number = static_cast<std::uint16_t>(s + 1);
    auto cells = static_cast<double>(claim_cells(*field.distance, frame_, number, owner_));
    if (cut_cells_) cells = cut_cells_->add(number, *field.distance, *halves, owner_);
    report_crossing(solid, field, cells);
    const double once = shells.volume - field.doubled + 2 * field.reversed;
    compare_volume(s, solid.closed() ? once : solid.volume, cells);
    if (distance_ == nullptr)
      distance_ = std::move(field.distance);
    else
      unite(*distance_, *field.distance);
  }

  void report_crossing(const SolidReport& solid, const SolidField& field, double cells) {
    const double percent = 100 / (cells * std::pow(frame_.cell, 3));
    if (field.doubled > 0)
      repaired(
          fmt::format("part \"{}\": {:.2g} % of its volume lies inside its surfaces more than "
                      "once; counted once",
                      solid.part, percent * field.doubled));
    if (field.reversed > 0)
      repaired(
          fmt::format("part \"{}\": {:.2g} % of its volume is inside out, because its surface "
                      "crosses itself; filled",
                      solid.part, percent * field.reversed));
  }

  // A fault of the mesh that was mended.
  void repaired(std::string text) {
    if (options_.repair == Repair::strict)
      throw InputError("voxelize: the mesh needs repair (repair = \"auto\" does this): " + text);
    report().repairs.push_back(std::move(text));
  }

  // A part that the cells do not resolve.
  void unresolved(std::string text) {
    if (options_.repair == Repair::strict) throw InputError("voxelize: " + text);
    warn(std::move(text));
  }

  void compare_volume(std::size_t s, double volume, double cells) {
    report().mesh_volume += volume;
    if (auto fault = volume_fault(mesh(), solids_[s], volume, cells, frame_.cell)) {
      unresolved(std::move(*fault));
      reported_.insert(s);
    }
  }

  void gather_cells() {
    std::vector<float> fraction;
    if (cut_cells_) fraction = std::move(*cut_cells_).finish(owner_);
    cut_cells_.reset();
    const auto count =
        owner_.size() - static_cast<std::size_t>(std::count(owner_.begin(), owner_.end(), 0));
    if (count == 0)
      throw InputError(
          fmt::format("voxelize: no cell of {} has its centre inside the mesh; use a smaller cell, "
                      "say {}",
                      format_quantity(frame_.cell, Dimension::length),
                      format_quantity(kFinerCell * frame_.cell, Dimension::length)));
    grid().cell = frame_.cell;
    grid().origin = frame_.origin;
    grid().distance = distance_;
    grid().cells.reserve(count);
    grid().material.reserve(count);  // the number of the solid until materials are assigned
    std::size_t n = 0;
    CellIndex c{};
    for (c[2] = 0; c[2] < frame_.size[2]; ++c[2])
      for (c[1] = 0; c[1] < frame_.size[1]; ++c[1])
        for (c[0] = 0; c[0] < frame_.size[0]; ++c[0], ++n) {
          if (owner_[n] == 0) continue;
          grid().cells.push_back(c);
          grid().material.push_back(static_cast<std::uint16_t>(owner_[n] - 1));
          if (!fraction.empty()) grid().fraction.push_back(fraction[n]);
        }
    std::vector<std::uint16_t>().swap(owner_);
    if (options_.cut_cells) grid().surface = surface_points(grid(), mesh());
  }

  // Call while grid().material has the numbers of the solids.
  void report_slivers() {
    const std::vector<std::uint16_t>& owners = grid().material;
    for (const Sliver& sliver : find_slivers(grid().cells, owners, *distance_, frame_.cell)) {
      if (reported_.contains(sliver.solid)) continue;
      const auto cells =
          static_cast<std::size_t>(std::count(owners.begin(), owners.end(), sliver.solid));
      if (auto fault = sliver_fault(solids_[sliver.solid], sliver, cells))
        unresolved(std::move(*fault));
    }
  }

  void count_bodies() {
    bodies_ = bodies_of(grid().cells);
    if (bodies_.count == 1) return;
    std::vector<std::size_t> cells(bodies_.count, 0);
    for (const std::uint32_t number : bodies_.of) ++cells[number];
    const auto [least, most] = std::minmax_element(cells.begin(), cells.end());
    const std::string sizes = *least == *most ? counted(*most, "cell") + " each"
                                              : fmt::format("{} to {} cells", *least, *most);
    warn(fmt::format("the cells form {} bodies that do not touch, of {}", bodies_.count, sizes));
  }

  void paint() {
    if (const auto& core = options_.core_shell;
        core && !paint_core(grid(), core->core_depth, materials_))
      warn(fmt::format("no cell lies deeper than core_depth = {:.4g} m; there is no core",
                       core->core_depth));
    if (options_.paint) paint_cells(grid(), options_.paint, frame_, materials_, options_.progress);
  }

  VoxelizedMesh finish() {
    if (auto warning = unused_materials(materials_, options_, mesh())) warn(std::move(*warning));
    const std::vector<MaterialInput> used = materials_.finish(grid().material);
    set_materials(grid(), used, bodies_);
    report().grid_volume = volume(grid());
    return std::move(result_);
  }

  const TriangleMesh& given_;
  const VoxelizeOptions& options_;
  MaterialChoice materials_;
  CellFrame frame_;
  std::vector<SolidReport> solids_;
  std::vector<std::uint16_t>
      owner_;  // solid + 1 of each cell of the frame until cells are gathered
  std::optional<CutCells> cut_cells_;
  std::set<std::size_t> reported_;  // solids whose cells have another volume
  DisjointSets::Numbers bodies_;    // that the cells form
  Field distance_;
  VoxelizedMesh result_;
};

}  // namespace

VoxelizedMesh voxelize(const TriangleMesh& mesh, const VoxelizeOptions& options) {
  return Voxelizer(mesh, options).run();
}

}  // namespace springlod::voxelize
