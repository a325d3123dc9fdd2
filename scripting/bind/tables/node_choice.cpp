#include "scripting/bind/tables/node_choice.hpp"

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/tables/model_table.hpp"
#include "scripting/engine/quantity.hpp"

namespace springlod::scripting {

namespace {

// The node number at the top of the stack, from 0; leaves it there.
std::uint32_t node_number(lua_State* L, const MassSpringModel& model, const std::string& what) {
  const lua_Integer number = lua_isinteger(L, -1) != 0 ? lua_tointeger(L, -1) : 0;
  if (number < 1 || number > static_cast<lua_Integer>(model.node_count()))
    throw InputError(fmt::format("{} must be a node number of 1 to {}, got {}", what,
                                 model.node_count(),
                                 lua_isinteger(L, -1) != 0 ? fmt::format("{}", lua_tointeger(L, -1))
                                                           : describe_type_at(L, -1)));
  return static_cast<std::uint32_t>(number - 1);
}

// Pushes the result of the function at `index` for a node.
void ask(lua_State* L, int index, const MassSpringModel& model, std::uint32_t node) {
  lua_pushvalue(L, index);
  push_node(L, model, node);
  lua_call(L, 1, 1);
}

std::vector<std::uint32_t> nodes_by_function(lua_State* L, int function,
                                             const MassSpringModel& model,
                                             const std::string& what) {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    ask(L, function, model, i);
    if (lua_toboolean(L, -1) != 0) nodes.push_back(i);
    lua_pop(L, 1);
  }
  // An empty choice is an error, because its usual cause is a wrong unit or sign.
  if (nodes.empty())
    throw InputError(
        fmt::format("{} is true for none of the {} nodes; print model:node(1) to see "
                    "what a node looks like, positions are in metres",
                    what, model.node_count()));
  return nodes;
}

}  // namespace

std::vector<std::uint32_t> nodes_at(lua_State* L, int index, const MassSpringModel& model,
                                    const std::string& what) {
  const int given = lua_absindex(L, index);
  if (lua_isfunction(L, given)) return nodes_by_function(L, given, model, what);
  if (!lua_istable(L, given))
    throw InputError(
        fmt::format("{} must be a list of node numbers or a function of a node, got {}", what,
                    describe_type_at(L, given)));
  std::vector<std::uint32_t> nodes;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, given)); ++i) {
    lua_rawgeti(L, given, i);
    nodes.push_back(node_number(L, model, fmt::format("{}[{}]", what, i)));
    lua_pop(L, 1);
  }
  return nodes;
}

std::vector<std::uint32_t> read_nodes(TableReader& reader, const char* name,
                                      const MassSpringModel& model) {
  const int given = reader.raw(name);
  if (given == 0) return {};
  return nodes_at(reader.lua(), given, model, fmt::format("{}: {}", reader.owner(), name));
}

std::vector<Vec3> read_forces(TableReader& reader, const MassSpringModel& model) {
  lua_State* L = reader.lua();
  const std::string what = reader.owner() + ": force";
  std::vector<Vec3> forces(model.node_count(), Vec3::Zero());
  const int given = reader.raw("force");
  if (given == 0) return forces;
  if (lua_isfunction(L, given)) {
    for (std::uint32_t i = 0; i < model.node_count(); ++i) {
      ask(L, given, model, i);
      if (!lua_isnil(L, -1))
        forces[i] = vector_at(L, -1, Dimension::number, fmt::format("{} of node {}", what, i + 1));
      lua_pop(L, 1);
    }
    return forces;
  }
  if (!lua_istable(L, given))
    reader.refuse("force", "a table from node numbers to {x, y, z} or a function of a node");
  lua_pushnil(L);
  while (lua_next(L, given) != 0) {
    lua_pushvalue(L, -2);
    const std::uint32_t node = node_number(L, model, what + ": its keys");
    lua_pop(L, 1);
    forces[node] = vector_at(L, -1, Dimension::number, fmt::format("{}[{}]", what, node + 1));
    lua_pop(L, 1);
  }
  return forces;
}

}  // namespace springlod::scripting
