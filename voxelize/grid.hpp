#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/choice.hpp"
#include "base/progress.hpp"
#include "model/material_input.hpp"
#include "model/mesh.hpp"

namespace springlod::voxelize {

using CellIndex = std::array<std::int32_t, 3>;

/// A point of the surface of a body, and the part of the surface that it stands for.
struct SurfacePoint {
  CellIndex cell{};  ///< a filled cell: the one that it lies in, or one next to that
  /// From the centre of the cell, in cells [1]; within 1/2 along each axis if it lies in the cell.
  std::array<float, 3> place{};
  std::array<float, 3> normal{};  ///< outward unit vector
  double area = 0;                ///< [m2] > 0
};

class DistanceField;  // an OpenVDB level set, defined only in voxelize/

/// A sparse grid: only filled cells are stored, sorted by (z, y, x), each with a material. Cell (i,
/// j, k) is the cube from origin + cell * (i, j, k) to origin + cell * (i+1, j+1, k+1).
struct MaterialGrid {
  double cell = 0;             ///< edge a [m] > 0
  Vec3 origin = Vec3::Zero();  ///< [m]
  std::vector<CellIndex> cells;
  std::vector<std::uint16_t> material;  ///< index into materials of each cell
  /// Depth of each cell's centre under the surface [m] (measure_depth); empty: not measured.
  std::vector<float> depth;
  /// Fraction of each cell that the body fills [1], above 0, at most 1; empty: all of it. See
  /// VoxelizeOptions::cut_cells.
  std::vector<float> fraction;
  /// Points of the body's surface, where it touches obstacles; empty: at the nodes of its lattice.
  std::vector<SurfacePoint> surface;
  std::vector<Material> materials;
  /// The materials as set_materials() got them; empty for grids that come with their materials.
  std::vector<MaterialInput> inputs;
  std::shared_ptr<const DistanceField>
      distance;  ///< of the whole solid; null for grids from tables

  double fraction_of(std::size_t n) const { return fraction.empty() ? 1 : fraction[n]; }
  Vec3 center(const CellIndex& c) const {
    return origin + cell * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5);
  }
};

/// Throws InputError for a cell size or origin that makes no sense, cells that are not sorted or
/// not unique, depths or fractions that are not one per cell, points of the surface outside its
/// cells, and materials that are missing or wrong.
void validate(const MaterialGrid& grid);

/// The cells of which at least half is inside, as whole ones, without points of a surface: for
/// models that do not know cut cells.
MaterialGrid whole_cells(const MaterialGrid& grid);

/// Volume of the cells, by their fractions [m3].
double volume(const MaterialGrid& grid);

/// Estimate of the lowest angular frequency of the free body [rad/s]: that of its slowest connected
/// component, by lowest_frequency_estimate with the largest edge of the component's bounding box
/// and the wave speed sqrt(1 / (<1/E> <rho>)), with averages over its cells: materials in series
/// (Reuss 1929). Cells are connected if they share at least a corner. 0 for an empty grid.
double lowest_frequency(const MaterialGrid& grid);

/// Gives the grid its materials; damping ratios become times with lowest_frequency(grid). Throws
/// InputError for a material out of range, and for a grid that is then not valid.
void set_materials(MaterialGrid& grid, const std::vector<MaterialInput>& inputs);

/// Smallest fraction of a cell that is inside a body and counts [1]. What is left out is far less
/// than the volume's error.
inline constexpr double kLeastFraction = 0.01;

/// A user's function of position and depth. Returns the name of a material, or "" to keep the
/// material of the cell.
using PaintFunction =
    std::function<std::string(const Vec3& center, double depth, const std::string& material)>;

/// What to do with meshes that are not closed surfaces of solid bodies.
enum class Repair { automatic, strict, off };

inline constexpr Choice<Repair> kRepairs[] = {
    {Repair::automatic, "auto",
     "close holes, turn triangles that face the wrong way, drop doubled ones, and say so"},
    {Repair::strict, "strict",
     "refuse meshes with faults, and parts that the cells do not resolve"},
    {Repair::off, "off", "take the mesh as it is; refuse holes"}};
constexpr ChoiceTable<Choice<Repair>> choices(Repair) {
  return {"repair", kRepairs};
}

struct VoxelizeOptions {
  /// Edge of a cell [m]; default: longest side of the bounding box / 32.
  std::optional<double> cell;
  /// Materials by the name of a part or, if there is none, by its material name in the file. Other
  /// parts take `fallback`.
  std::map<std::string, MaterialInput> materials;
  MaterialInput fallback{{.name = "default"}};
  /// Parts in the order in which they claim cells: a cell within several parts goes to the first of
  /// them. Parts that are not listed follow in file order.
  std::vector<std::string> priority;
  /// Core and shell: cells deeper than `core_depth` [m] become `core`.
  struct CoreShell {
    double core_depth = 0;
    MaterialInput core;
  };
  std::optional<CoreShell> core_shell;
  PaintFunction paint;
  Repair repair = Repair::automatic;
  /// Whether cells that the surface cuts count by the fraction of them that is inside, and the body
  /// touches obstacles at points of its surface: for round and slanting surfaces.
  bool cut_cells = false;
  /// Whether build_lattice() follows: then its memory is required too, before the cells are made.
  bool for_lattice = false;
  std::uint32_t threads = 0;  ///< 0: all cores. Never changes the result
  Progress* progress = nullptr;
};

struct VoxelizeReport {
  double cell = 0;                    ///< [m]
  bool cell_chosen = false;           ///< true if options.cell was not given
  std::vector<std::string> repairs;   ///< what was mended (describe(SolidRepair))
  std::vector<std::string> warnings;  ///< such as volume errors, unused materials
  double mesh_volume = 0;             ///< sum over the parts [m3]
  double grid_volume = 0;             ///< filled cells, by their fractions [m3]
};

struct VoxelizedMesh {
  MaterialGrid grid;
  std::optional<TriangleMesh> repaired;  ///< the mesh, if it was repaired; its holes are open
  VoxelizeReport report;
};

/// Fills the cells whose centre is inside a solid or on its surface (solids of check_solid; OpenVDB
/// meshToVolume). The grid is centred on the bounding box. A shell inside another one that faces
/// inwards is a cavity and stays empty. In a solid of several materials each cell takes that of the
/// nearest triangle. With `cut_cells`, all cells are filled of which at least kLeastFraction is
/// inside; one whose centre is outside has the material of the nearest solid. Depths are measured
/// if `core_shell` or `paint` needs them. Damping ratios become times (set_materials). Solids with
/// holes are filled where their winding number is above 1/2 (wound_cells), after repair().
///
/// Throws InputError: a cell too large (no cell is filled) or too small (the message has the
/// smallest possible one), more cells than the memory holds, coordinates that are not finite, a
/// mesh too far from the origin, a flat mesh, unknown names in `priority` or from `paint`,
/// different materials of one name; with Repair::strict any fault of the mesh, and parts whose
/// cells have a volume that is far off; with Repair::off an open solid (the message has the part
/// and a hole).
VoxelizedMesh voxelize(const TriangleMesh& mesh, const VoxelizeOptions& options);

}  // namespace springlod::voxelize
