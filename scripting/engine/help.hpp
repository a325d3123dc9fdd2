#pragma once

#include <string>
#include <vector>

#include "scripting/engine/api.hpp"

struct lua_State;

namespace springlod::scripting {

/// What help() prints: all functions by group, all types.
std::string overview(const Api& api);
/// How one function is called: arguments, options with units and defaults, errors, an example.
std::string help_for(const FunctionEntry& entry);
std::string help_for(const TypeEntry& type);
std::string help_for(const RecordEntry& record);
/// The words of one table of choices.
std::string help_for(const Words& words);
/// By name: "simplify", "Mesh", "Model:node", "Material". Throws InputError with near names.
std::string help_for(const Api& api, const std::string& name);
/// For whatever lies at `index`: a function of the module, a value, a name.
std::string help_at(lua_State* L, int index, const Api& api);

/// docs/api.md: everything above as Markdown.
std::string api_markdown(const Api& api);

/// "voxelize(mesh, {cell, materials, ...}) -> Grid"
std::string signature(const FunctionEntry& entry);
/// "quantity in m, default 1"; also for records.
std::string type_and_default(const Parameter& parameter);

/// Names a word at the prompt may be completed to: "s.", "voxelize", "help" ...
std::vector<std::string> help_topics(const Api& api);

}  // namespace springlod::scripting
