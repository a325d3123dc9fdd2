#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::scripting {

/// Line width of help where there is no narrower terminal.
inline constexpr std::size_t kHelpWidth = 88;

// Signatures and examples are not wrapped to the width.

/// Text of help(): all functions by group, types, records and constants.
std::string overview(const Api& api, std::size_t width = kHelpWidth);
/// Documentation of one function: arguments, options with units and defaults, errors, example.
std::string help_for(const FunctionEntry& entry, std::size_t width = kHelpWidth);
std::string help_for(const TypeEntry& type, std::size_t width = kHelpWidth);
std::string help_for(const RecordEntry& record, std::size_t width = kHelpWidth);
/// The words of one table of choices.
std::string help_for(const Words& words, std::size_t width = kHelpWidth);
std::string help_for(const ConstantEntry& constant, std::size_t width = kHelpWidth);
/// Documentation by name, such as "simplify", "Mesh", "Model:node", "Material". Throws InputError
/// with similar names if there is none.
std::string help_for(const Api& api, const std::string& name, std::size_t width = kHelpWidth);
/// Documentation of the Lua value at `index`: a function of the module, a value or a name.
std::string help_at(lua_State* L, int index, const Api& api, std::size_t width = kHelpWidth);

/// All names that help() knows.
std::vector<std::string> help_topics(const Api& api);

/// The content of docs/api.md: all documentation as Markdown.
std::string api_markdown(const Api& api);

/// "voxelize(mesh, {cell, materials, ...}) -> Grid"
std::string signature(const FunctionEntry& entry);
/// "quantity in m, default 1"; also for records.
std::string type_and_default(const Parameter& parameter);

}  // namespace springlod::scripting
