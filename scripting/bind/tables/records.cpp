#include "scripting/bind/tables/records.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "model/material_preset.hpp"

namespace springlod::scripting {

MaterialInput read_material(Call& call, int index, const std::string& owner,
                            const std::string& name) {
  MaterialInput input;
  Material& material = input.material;
  material.name = name;
  TableReader reader = call.record(index, "Material", owner);
  reader.read("name", material.name);
  if (reader.has("preset")) {
    MaterialPreset preset{};
    reader.read("preset", preset);
    apply(preset, material);
  }
  reader.read("young", material.young);
  reader.read("density", material.density);
  reader.read("damping", material.damping);
  reader.read("damping_ratio", input.damping_ratio);
  reader.read("poisson", material.poisson);
  reader.read("colour", material.colour);
  reader.finish();
  if (reader.has("damping") && reader.has("damping_ratio"))
    throw InputError(
        fmt::format("{}: damping and damping_ratio are both given; give either damping (a time) or "
                    "damping_ratio",
                    owner));
  if (reader.has("damping")) input.damping_ratio.reset();
  validate(input);
  return input;
}

std::map<std::string, MaterialInput> read_materials(Call& call, int table,
                                                    const std::string& owner) {
  std::map<std::string, MaterialInput> into;
  lua_State* L = call.lua();
  if (!lua_istable(L, table))
    throw InputError(
        fmt::format("{}: materials must be a table of materials by name, as in {{rod = {{young = "
                    "\"1 MPa\"}}}}, got {}",
                    owner, describe_type_at(L, table)));
  lua_pushnil(L);
  while (lua_next(L, table) != 0) {
    if (lua_type(L, -2) != LUA_TSTRING)
      throw InputError(owner + ": materials are named, as in {rod = {young = ...}}");
    const std::string name = lua_tostring(L, -2);
    into[name] = read_material(call, lua_gettop(L), "materials." + name, name);
    lua_pop(L, 1);
  }
  return into;
}

void push_material(lua_State* L, const Material& material) {
  begin_table(L);
  set_field(L, "name", material.name);
  set_field(L, "young", material.young);
  set_field(L, "poisson", material.poisson);
  set_field(L, "density", material.density);
  set_field(L, "damping", material.damping);
  // Single precision shown as double would read 0.699999988.
  const Vec3 colour(material.colour.r, material.colour.g, material.colour.b);
  set_field(L, "colour", Vec3((colour.array() * 1e6).round() / 1e6));
}

void push_materials(lua_State* L, const std::vector<Material>& materials) {
  begin_list(L, materials.size());
  for (std::size_t i = 0; i < materials.size(); ++i) {
    push_material(L, materials[i]);
    end_list_entry(L, i + 1);
  }
}

void push_provenance(lua_State* L, const Provenance& provenance) {
  begin_table(L);
  for (const auto& [key, entry] : provenance.entries) set_field(L, key.c_str(), entry);
}

}  // namespace springlod::scripting
