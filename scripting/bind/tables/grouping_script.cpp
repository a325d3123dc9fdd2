#include "scripting/bind/tables/grouping_script.hpp"

#include <vector>

#include <fmt/format.h>
#include <lua.hpp>

#include "base/error.hpp"
#include "base/message.hpp"
#include "lod/grouping/grouping.hpp"
#include "scripting/bind/tables/model_table.hpp"

namespace springlod::scripting {

namespace {

using NodeSets = std::vector<std::vector<std::uint32_t>>;

// The node tables passed to the script's function, made once for each node and level: a Lua list at
// stack index `cache`.
void push_cached_node(lua_State* L, int cache, const MassSpringModel& model, std::uint32_t node) {
  if (lua_rawgeti(L, cache, node + 1) != LUA_TNIL) return;
  lua_pop(L, 1);
  push_node(L, model, node);
  lua_pushvalue(L, -1);
  lua_rawseti(L, cache, node + 1);
}

double number_result(lua_State* L, const char* what) {
  if (lua_type(L, -1) != LUA_TNUMBER)
    throw InputError(
        fmt::format("simplify: {} must return a number, got {}", what, describe_type_at(L, -1)));
  const double value = lua_tonumber(L, -1);
  lua_pop(L, 1);
  return value;
}

lod::GroupMaker function_groups(lua_State* L, const lod::GroupingOptions& usual, int node_priority,
                                int pair_cost) {
  return [=](const MassSpringModel& fine, const Groups& /*of_base*/, std::uint32_t /*level*/) {
    lua_newtable(L);
    const int cache = lua_gettop(L);
    lod::GroupingOptions grouping = usual;
    if (node_priority != 0)
      grouping.node_priority = [&fine, L, cache, node_priority](std::uint32_t node) {
        lua_pushvalue(L, node_priority);
        push_cached_node(L, cache, fine, node);
        lua_call(L, 1, 1);
        return number_result(L, "node_priority");
      };
    if (pair_cost != 0)
      grouping.pair_cost = [&fine, L, cache, pair_cost](std::uint32_t a, std::uint32_t b) {
        lua_pushvalue(L, pair_cost);
        push_cached_node(L, cache, fine, a);
        push_cached_node(L, cache, fine, b);
        lua_call(L, 2, 1);
        return number_result(L, "pair_cost");
      };
    Groups groups = lod::group_nodes(fine, grouping);
    lua_settop(L, cache - 1);
    return groups;
  };
}

NodeSets read_sets(lua_State* L, int list, const std::string& what) {
  NodeSets sets;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, list)); ++i) {
    if (lua_rawgeti(L, list, i) != LUA_TTABLE)
      throw InputError(fmt::format("simplify: {}[{}] must be a list of node numbers", what, i));
    std::vector<std::uint32_t>& set = sets.emplace_back();
    for (lua_Integer j = 1; j <= static_cast<lua_Integer>(lua_rawlen(L, -1)); ++j) {
      lua_rawgeti(L, -1, j);
      const lua_Integer node = lua_isinteger(L, -1) != 0 ? lua_tointeger(L, -1) : 0;
      if (node < 1 || node > 0xFFFFFFFFLL)
        throw InputError(
            fmt::format("simplify: {}[{}][{}] must be a node number, from 1 up", what, i, j));
      set.push_back(static_cast<std::uint32_t>(node - 1));
      lua_pop(L, 1);
    }
    lua_pop(L, 1);
  }
  return sets;
}

// {{1, 2}, {3, 4}} names the groups of level 1; {{{1, 2}}, {{1, 2}}} those of level 1, 2, ...
bool one_level(lua_State* L, int list) {
  lua_rawgeti(L, list, 1);
  if (lua_istable(L, -1)) {
    lua_rawgeti(L, -1, 1);
  } else {
    lua_pushnil(L);
  }
  const bool deeper = lua_istable(L, -1);
  lua_pop(L, 2);
  return !deeper;
}

void read_hand_groups(TableReader& reader, int list, lod::SimplifyOptions& options) {
  lua_State* L = reader.lua();
  std::vector<NodeSets> by_level;
  if (one_level(L, list)) {
    by_level.push_back(read_sets(L, list, "grouping"));
  } else {
    for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, list)); ++i) {
      lua_rawgeti(L, list, i);
      by_level.push_back(read_sets(L, lua_gettop(L), fmt::format("grouping[{}]", i)));
      lua_pop(L, 1);
    }
  }
  const auto levels = static_cast<std::uint32_t>(by_level.size());
  if (reader.has("levels") && options.levels != levels)
    reader.refuse("levels", fmt::format("left out or {}: grouping names the groups of {}", levels,
                                        counted(levels, "level")));
  options.levels = levels;
  options.groups = [by_level](const MassSpringModel& fine, const Groups& /*of_base*/,
                              std::uint32_t level) {
    return lod::groups_from_sets(fine, by_level.at(level - 1));
  };
  options.made_by = "groups by hand";
}

int parameter_count(lua_State* L, int function) {
  lua_Debug about{};
  lua_pushvalue(L, function);
  lua_getinfo(L, ">u", &about);
  return about.nparams;
}

int function_option(TableReader& reader, const char* name) {
  const int function = reader.raw(name);
  if (function != 0 && !lua_isfunction(reader.lua(), function)) reader.refuse(name, "a function");
  return function;
}

}  // namespace

void read_grouping(TableReader& reader, lod::SimplifyOptions& options) {
  lua_State* L = reader.lua();
  int node_priority = function_option(reader, "node_priority");
  int pair_cost = function_option(reader, "pair_cost");
  const int given = reader.raw("grouping");
  if (given != 0 && lua_istable(L, given)) {
    if (node_priority != 0 || pair_cost != 0)
      reader.refuse("grouping", "a word if node_priority or pair_cost is given");
    read_hand_groups(reader, given, options);
    return;
  }
  if (given != 0 && lua_isfunction(L, given)) {
    const int parameters = parameter_count(L, given);
    if (parameters != 1 && parameters != 2)
      reader.refuse("grouping",
                    "a function of one node (its priority) or of two (the cost of "
                    "the pair)");
    (parameters == 1 ? node_priority : pair_cost) = given;
  } else {
    reader.read("grouping", options.grouping.grouping);
  }
  if (node_priority == 0 && pair_cost == 0) return;
  if (choice_of(options.grouping.grouping).traits.from_base)
    reader.refuse("grouping", "one that grows pairs if node_priority or pair_cost is given");
  options.groups = function_groups(L, options.grouping, node_priority, pair_cost);
  options.made_by = fmt::format("{} of the script, border {}, seed {}",
                                pair_cost == 0       ? "node_priority"
                                : node_priority == 0 ? "pair_cost"
                                                     : "node_priority and pair_cost",
                                to_string(options.grouping.border), options.grouping.seed);
}

void extend_grouping_parameter(Parameter& grouping) {
  grouping.type = "function, list of lists of node numbers, or one of";
  grouping.help +=
      ". A function of one node returns its priority, a function of two nodes the cost of merging "
      "them. A list of lists has the groups of level 1; a list of such lists has those of level 1, "
      "2, ...";
}

std::vector<Parameter> grouping_function_parameters() {
  return {{.name = "node_priority",
           .type = "function(node) -> number",
           .fallback = "none",
           .help = "order in which nodes are visited, low first; node is a Node table"},
          {.name = "pair_cost",
           .type = "function(a, b) -> number",
           .fallback = "none",
           .help = "order in which neighbours merge, lowest first; a and b are Node tables joined "
                   "by a spring; math.huge forbids the pair"}};
}

}  // namespace springlod::scripting
