#pragma once

#include <map>
#include <string>
#include <vector>

#include "model/chain.hpp"
#include "model/material_input.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// The Material table at `index`; `owner` names the table in messages; `name` is the material's
/// name if the table has none.
MaterialInput read_material(Call& call, int index, const std::string& owner,
                            const std::string& name);
/// {rod = {young = ...}, ...} at `table`: materials by name, any name.
std::map<std::string, MaterialInput> read_materials(Call& call, int table,
                                                    const std::string& owner);
void push_material(lua_State* L, const Material& material);
void push_materials(lua_State* L, const std::vector<Material>& materials);
/// {key = entry, ...}
void push_provenance(lua_State* L, const Provenance& provenance);

}  // namespace springlod::scripting
