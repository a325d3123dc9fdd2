#pragma once

#include <string>
#include <string_view>

#include "voxelize/mesh/import.hpp"

namespace springlod::voxelize {

/// An imported mesh as bytes, for another process of this machine.
std::string to_bytes(const ImportedMesh& imported);
/// Throws IoError if the bytes end too soon, and InputError if the mesh is not valid.
ImportedMesh mesh_from_bytes(std::string_view bytes);

}  // namespace springlod::voxelize
