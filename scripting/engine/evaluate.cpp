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

// Loads the chunk, as an expression if it is one. On failure, the error message is on the stack.
int load(lua_State* L, const std::string& input) {
  const std::string expression = "return " + input;
  const int status = luaL_loadbufferx(L, expression.data(), expression.size(), kChunkName, "t");
  if (status == LUA_OK) return status;
  lua_pop(L, 1);
  return luaL_loadbufferx(L, input.data(), input.size(), kChunkName, "t");
}

// Ctrl-C is done with when the chunk has stopped; other requests end the prompt too.
void clear_ctrl_c() {
  if (stop_cause() == StopCause::interrupt) clear_interrupt();
}

}  // namespace

bool needs_more_lines(ScriptState& state, const std::string& input) {
  lua_State* L = state.lua();
  const bool incomplete = is_incomplete(L, load(L, input));
  lua_pop(L, 1);
  return incomplete;
}

Reply evaluate(ScriptState& state, const std::string& input) {
  lua_State* L = state.lua();
  const int bottom = lua_gettop(L);
  clear_ctrl_c();
  Reply reply;
  if (load(L, input) != LUA_OK) {
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
  clear_ctrl_c();
  return reply;
}

}  // namespace springlod::scripting
