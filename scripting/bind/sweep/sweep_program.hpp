#pragma once

#include <filesystem>
#include <string>

#include "scripting/engine/api.hpp"

// What the functions of the folders of sweeps share.

namespace springlod::scripting {

std::filesystem::path this_program();
/// Hash of the running program and all stock scripts, which studies are made of.
std::string program_hash();

/// The arguments "sweep" and "folder" of functions.
Parameter sweep_argument();
Parameter sweep_folder_argument();

}  // namespace springlod::scripting
