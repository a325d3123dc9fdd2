#include "tests/fuzz/api_session.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include <lua.hpp>

#include "scripting/bind/topics.hpp"
#include "tests/fuzz/deadline.hpp"

namespace springlod::fuzz {
namespace {

constexpr const char* kValues = R"lua(
s = require "springlod"
local grid = s.grid{cell = 0.1, size = {2, 2, 1},
  materials = {rubber = {young = 1e6, damping = 0.004}, steel = {young = 1e7}},
  fill = function(x) return x < 0.1 and "rubber" or "steel" end}
local chain = s.simplify(s.lattice(grid), {levels = 1})
local scene = s.scenario{duration = 0.01, obstacles = {{plane = {0, 0, 1, 0}, name = "floor"}}}
values = {
  Grid = grid, Model = chain[0], LodChain = chain, Scenario = scene,
  Trajectory = s.run(chain[0], scene),
  functions = {
    function() end, function() return "rubber" end, function() return 1 end,
    function() return true end, function() return {} end, function(...) return ... end,
    function() error("no") end, function() return 0 / 0 end,
  },
}
local function steps(model)
  local step = s.stable_step(model)
  return 5 * (step < math.huge and step or 1e-3)
end
function use_scenario(scenario)
  pcall(s.run, values.Model, scenario, {step = math.min(scenario.duration, steps(values.Model)),
                                        frame_rate = 0, quiet = true})
end
function use_grid(grid)
  if grid.cell_count < 1000 then use_model(s.lattice(grid)) end
end
function use_model(model)
  pcall(s.run, model, {duration = steps(model)}, {frame_rate = 0, quiet = true})
end
)lua";

// Kinds of errors that are results: see the type Error of the API. "internal" is a bug, and
// "memory" what should have been refused before.
constexpr std::string_view kRefusals[] = {"input", "io", "unstable", "tunnelled", "interrupted"};

bool is_refusal(lua_State* L) {
  if (lua_type(L, -1) == LUA_TSTRING) return true;  // of Lua itself, or of a function of the script
  if (lua_type(L, -1) != LUA_TUSERDATA) return false;
  lua_getfield(L, -1, "kind");
  const char* kind = lua_tostring(L, -1);
  const bool refused = kind != nullptr && std::find(std::begin(kRefusals), std::end(kRefusals),
                                                    std::string_view(kind)) != std::end(kRefusals);
  lua_pop(L, 1);
  return refused;
}

}  // namespace

ApiSession::ApiSession()
    : state_({.verbosity = scripting::Verbosity::quiet}, scripting::make_api()) {
  const scripting::Outcome outcome = state_.run_text(kValues, "values", {});
  if (outcome.done) return;
  std::fprintf(stderr, "%s\n", outcome.message.c_str());
  std::abort();
}

void ApiSession::push_arguments(const scripting::FunctionEntry& function, Choices& choices) {
  ValueMaker maker(lua(), api(), choices);
  for (const scripting::Parameter& argument : function.arguments) maker.push(argument);
  if (!function.options.empty()) maker.push_table(function.options);
}

bool ApiSession::protected_call(int arguments, int results) {
  lua_State* L = lua();
  const Deadline deadline;
  if (lua_pcall(L, arguments, results, 0) == LUA_OK) return true;
  if (!is_refusal(L)) {
    std::fprintf(stderr, "no clear refusal: %s\n", luaL_tolstring(L, -1, nullptr));
    std::abort();
  }
  lua_pop(L, 1);
  return false;
}

void ApiSession::call(const scripting::FunctionEntry& function, Choices& choices) {
  call_and_use(function, choices, nullptr);
}

void ApiSession::call_and_use(const scripting::FunctionEntry& function, Choices& choices,
                              const char* use) {
  lua_State* L = lua();
  lua_settop(L, 0);
  lua_getglobal(L, "s");
  lua_getfield(L, -1, function.name.c_str());
  lua_replace(L, -2);
  push_arguments(function, choices);
  if (protected_call(lua_gettop(L) - 1, 1) && use != nullptr) {
    lua_getglobal(L, use);
    lua_insert(L, -2);
    protected_call(1, 0);
  }
  lua_settop(L, 0);
}

void ApiSession::call_method(const scripting::FunctionEntry& method, Choices& choices) {
  lua_State* L = lua();
  lua_settop(L, 0);
  lua_getglobal(L, "values");
  lua_getfield(L, -1, method.owner.c_str());
  if (lua_isnil(L, -1)) return lua_settop(L, 0);
  lua_getfield(L, -1, method.name.c_str());
  lua_replace(L, 1);  // the function, then the value as its self
  push_arguments(method, choices);
  protected_call(lua_gettop(L) - 1, 0);
  lua_settop(L, 0);
}

}  // namespace springlod::fuzz
