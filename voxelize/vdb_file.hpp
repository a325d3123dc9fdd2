#pragma once

#include <filesystem>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Writes the grids "distance" (float level set; made from the cells if the grid has none),
/// "material" (int32 number, -1 outside), "young", "density" and, if known, "depth" (float), all
/// with cell centres at integer indices. The cell, the origin and the materials are file metadata,
/// so load_vdb restores the same grid. Throws InputError (an invalid grid) and IoError.
void save_vdb(const MaterialGrid& grid, const std::filesystem::path& path);
/// Reads a file of save_vdb. Throws IoError for a missing file, a file that is not a .vdb file, and
/// one without these grids.
MaterialGrid load_vdb(const std::filesystem::path& path);

}  // namespace springlod::voxelize
