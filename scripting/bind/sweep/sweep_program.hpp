#pragma once

#include <filesystem>
#include <string>

#include "scripting/engine/api.hpp"
#include "sweep/plan.hpp"

// What the functions of the folders of sweeps share.

namespace springlod::scripting {

class Session;

std::filesystem::path this_program();
/// Hash of the running program and all stock scripts, which studies are made of.
std::string program_hash();
/// The plan of a folder. Throws as read_plan and require_unchanged, and InputError if this program
/// has --portable and the plan has not.
sweep::Plan checked_plan(const Session& session, const std::filesystem::path& folder);

/// The arguments "sweep" and "folder" of functions.
Parameter sweep_argument();
Parameter sweep_folder_argument();

}  // namespace springlod::scripting
