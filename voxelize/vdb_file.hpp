#pragma once

#include <filesystem>

#include "voxelize/grid.hpp"

namespace springlod {

/// Four grids: "distance" (float level set), "material" (int32 number), "young", "density" (float);
/// the materials by name, the cell and the origin as file metadata. Throws IoError.
void save_vdb(const MaterialGrid& grid, const std::filesystem::path& path);
/// Throws IoError: not a .vdb file, or one without our grids.
MaterialGrid load_vdb(const std::filesystem::path& path);

}  // namespace springlod
