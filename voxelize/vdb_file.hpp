#pragma once

#include <filesystem>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Grids "distance" (float level set, of the cells themselves if the grid has none), "material"
/// (int32 number, -1 outside), "young", "density" and, if known, "depth" (float), all with cell
/// centres at whole indices; cell, origin and the materials in full as file metadata, so that
/// load_vdb gives back the same grid. Throws InputError (an invalid grid) and IoError.
void save_vdb(const MaterialGrid& grid, const std::filesystem::path& path);
/// Throws IoError: no such file, not a .vdb file, or one without our grids.
MaterialGrid load_vdb(const std::filesystem::path& path);

}  // namespace springlod::voxelize
