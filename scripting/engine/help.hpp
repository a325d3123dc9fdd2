#pragma once

#include <string>
#include <vector>

#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::scripting {

/// Text of help(): all functions by group, types, records and constants.
std::string overview(const Api& api);
/// Documentation of one function: arguments, options with units and defaults, errors, example.
std::string help_for(const FunctionEntry& entry);
std::string help_for(const TypeEntry& type);
std::string help_for(const RecordEntry& record);
/// The words of one table of choices.
std::string help_for(const Words& words);
/// Documentation by name, such as "simplify", "Mesh", "Model:node", "Material". Throws InputError
/// with similar names if there is none.
std::string help_for(const Api& api, const std::string& name);
/// Documentation of the Lua value at `index`: a function of the module, a value or a name.
std::string help_at(lua_State* L, int index, const Api& api);

/// The content of docs/api.md: all documentation as Markdown.
std::string api_markdown(const Api& api);

/// "voxelize(mesh, {cell, materials, ...}) -> Grid"
std::string signature(const FunctionEntry& entry);
/// "quantity in m, default 1"; also for records.
std::string type_and_default(const Parameter& parameter);

}  // namespace springlod::scripting
