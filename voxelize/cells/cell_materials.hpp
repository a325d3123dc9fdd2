#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/mesh.hpp"
#include "voxelize/cells/frame.hpp"
#include "voxelize/cells/material_choice.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

// The stages that give cells their materials: `grid.material` has numbers of `materials`.

/// All cells of a solid of one material have that material. In a solid of several, each cell takes
/// that of the nearest triangle. Before, `grid.material` has the numbers of the solids, from 0.
void assign_part_materials(MaterialGrid& grid, const TriangleMesh& mesh,
                           const std::vector<SolidReport>& solids, const CellFrame& frame,
                           MaterialChoice& materials);

/// Cells deeper than `core_depth` [m] become the core; whether there are any. Throws InputError for
/// a negative depth.
bool paint_core(MaterialGrid& grid, double core_depth, MaterialChoice& materials);

/// Asks the user's function for the material of each cell.
void paint_cells(MaterialGrid& grid, const PaintFunction& paint, const CellFrame& frame,
                 MaterialChoice& materials, Progress* progress);

/// A warning of materials that were given and are not used; nothing if all are.
std::optional<std::string> unused_materials(const MaterialChoice& materials,
                                            const VoxelizeOptions& options,
                                            const TriangleMesh& mesh);

}  // namespace springlod::voxelize
