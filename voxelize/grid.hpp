#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/material.hpp"
#include "model/mesh.hpp"

namespace springlod::voxelize {

using CellIndex = std::array<std::int32_t, 3>;

class DistanceField;  // an OpenVDB level set; only voxelize/ sees inside

/// Filled cells, each with a material. Sparse: only filled cells are stored, sorted by (z, y, x).
/// Cell (i, j, k) is the cube from origin + cell * (i, j, k) to origin + cell * (i+1, j+1, k+1).
struct MaterialGrid {
  double cell = 0;             ///< edge a [m] > 0
  Vec3 origin = Vec3::Zero();  ///< [m]
  std::vector<CellIndex> cells;
  std::vector<std::uint16_t> material;  ///< a number into materials for each cell
  /// Of the cell's centre under the surface [m]; empty: not measured (measure_depth() does).
  std::vector<float> depth;
  std::vector<Material> materials;
  std::shared_ptr<const DistanceField>
      distance;  ///< of the whole solid; null for grids from tables
};

/// Throws InputError on unsorted or doubled cells or a material number out of range.
void validate(const MaterialGrid& grid);

/// What the Lua function of position and depth sees; returns the name of a material or "" for the
/// material the cell already has.
using PaintFunction =
    std::function<std::string(const Vec3& center, double depth, const std::string& material)>;

struct VoxelizeOptions {
  /// Edge of a cell [m]; left out: longest side of the bounding box / 32.
  std::optional<double> cell;
  /// Materials by the name of a part, else by the file's material name; a part found under neither
  /// takes `fallback`.
  std::map<std::string, Material> materials;
  Material fallback{.name = "default"};
  /// Order in which parts claim cells: a cell in several parts goes to the part named first; parts
  /// not named follow in file order.
  std::vector<std::string> priority;
  /// Core and shell: cells deeper than `core_depth` [m] become `core`.
  struct CoreShell {
    double core_depth = 0;
    Material core;
  };
  std::optional<CoreShell> core_shell;
  PaintFunction paint;
  std::uint32_t threads = 0;  ///< 0: all cores. Never changes the result
  Progress* progress = nullptr;
};

struct VoxelizeReport {
  double cell = 0;
  bool cell_chosen = false;           ///< true if options.cell was left out
  std::vector<std::string> warnings;  ///< e.g. voxel volume off the mesh volume, material not used
  double mesh_volume = 0;             ///< sum over the parts [m3]
  double grid_volume = 0;             ///< filled cells [m3]
};

struct VoxelizedMesh {
  MaterialGrid grid;
  VoxelizeReport report;
};

/// Fills the cells whose centre is inside or on the surface, solid by solid (check_solid; OpenVDB
/// meshToVolume), on a grid that is centred on the bounding box. Shells that face inwards within
/// another are cavities and stay empty. In a solid of several materials each cell takes that of the
/// nearest triangle. Depths are measured if a core or a paint function asks for them
/// (measure_depth). Throws InputError: an open solid (names part and hole), a cell too large
/// (nothing filled) or so small that the grid would not fit (says the smallest that does), NaN, a
/// mesh too far from the origin, a flat one, names in `priority` or from `paint` that do not exist,
/// materials that clash.
VoxelizedMesh voxelize(const TriangleMesh& mesh, const VoxelizeOptions& options);

}  // namespace springlod::voxelize
