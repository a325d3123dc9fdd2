// Evaluation of a chunk of input at the prompt.

#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/engine/inspect.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/repl.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kChunkName = "=input";

// The same test as in lua.c: the parser stopped at the end of the input.
bool is_incomplete(lua_State* L, int status) {
  constexpr std::string_view kMark = "<eof>";
  if (status != LUA_ERRSYNTAX) return false;
  return std::string_view(lua_tostring(L, -1)).ends_with(kMark);
}

// Prints all its arguments. Called in protected mode, because a user's __tostring can fail.
int print_results(lua_State* L) {
  std::string line;
  for (int i = 1; i <= lua_gettop(L); ++i) {
    if (i > 1) line += "  ";
    line += inspect(L, i);
  }
  fmt::print("{}\n", line);
  std::fflush(stdout);
  return 0;
}

}  // namespace

Reply evaluate(ScriptState& state, const std::string& input) {
  lua_State* L = state.lua();
  const int bottom = lua_gettop(L);
  clear_interrupt();
  const std::string expression = "return " + input;
  int status = luaL_loadbufferx(L, expression.data(), expression.size(), kChunkName, "t");
  if (status != LUA_OK) {
    lua_settop(L, bottom);
    status = luaL_loadbufferx(L, input.data(), input.size(), kChunkName, "t");
  }
  Reply reply;
  if (status != LUA_OK) {
    reply.incomplete = is_incomplete(L, status);
    reply.error = lua_tostring(L, -1);
    lua_settop(L, bottom);
    return reply;
  }
  Outcome outcome = state.call(0, LUA_MULTRET);
  if (outcome.done && lua_gettop(L) > bottom) {
    lua_pushcfunction(L, print_results);
    lua_insert(L, bottom + 1);
    outcome = state.call(lua_gettop(L) - bottom - 1, 0);
  }
  lua_settop(L, bottom);
  if (!outcome.done)
    reply.error =
        outcome.interrupted ? stop_text(stop_cause()) : outcome.message + "\n" + outcome.traceback;
  clear_interrupt();
  return reply;
}

}  // namespace springlod::scripting
