#pragma once

#include <string>
#include <string_view>

#include "voxelize/import.hpp"

namespace springlod::voxelize {

/// An imported mesh as bytes, for another process of this machine.
std::string to_bytes(const ImportedMesh& imported);
/// Throws InputError if they are not those of a valid mesh.
ImportedMesh mesh_from_bytes(std::string_view bytes);

}  // namespace springlod::voxelize
