#pragma once

#include <filesystem>

#include "voxelize/mesh/import.hpp"

namespace springlod::voxelize {

/// Reads a mesh file through assimp in this process, which may crash or hang if the file is
/// damaged; see import_mesh.
ImportedMesh read_mesh(const std::filesystem::path& path, const ImportOptions& options);

}  // namespace springlod::voxelize
