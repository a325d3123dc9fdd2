// Evaluation of a chunk of input at the prompt.

#include <algorithm>
#include <cstdio>
#include <string_view>

#include <fmt/format.h>
#include <lua.hpp>

#include "scripting/engine/call.hpp"
#include "scripting/engine/cursor.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/inspect.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/repl.hpp"
#include "scripting/engine/value.hpp"

namespace springlod::scripting {

namespace {

constexpr const char* kChunkName = "=input";

// The same test as in lua.c: the parser stopped at the end of the input.
bool is_incomplete(lua_State* L, int status) {
  constexpr std::string_view kMark = "<eof>";
  if (status != LUA_ERRSYNTAX) return false;
  return std::string_view(lua_tostring(L, -1)).ends_with(kMark);
}

// What a function of the API is, and how to call it; "" for any other value. `input`: the
// expression that it is the value of.
std::string function_text(lua_State* L, int index, std::string_view input) {
  const FunctionEntry* entry = entry_of_function(L, index);
  if (entry == nullptr) return "";
  const std::string call = signature(*entry);
  if (entry->owner.empty())
    return fmt::format("a function: {}; help(s.{}) explains it", call, entry->name);
  const std::size_t dot = input.rfind('.');
  const bool names_value =
      dot != std::string_view::npos && input.substr(dot + 1) == entry->name &&
      std::all_of(input.begin(), input.end(), [](char c) { return c == '.' || is_name_letter(c); });
  return fmt::format("a method: call {}{}; help(\"{}:{}\") explains it",
                     names_value ? input.substr(0, dot) : call.substr(0, call.find(':')),
                     call.substr(call.find(':')), entry->owner, entry->name);
}

// Prints all its arguments. Upvalue: the input. Called in protected mode, because a user's
// __tostring can fail.
int print_results(lua_State* L) {
  std::string line;
  for (int i = 1; i <= lua_gettop(L); ++i) {
    if (i > 1) line += "  ";
    const std::string function = function_text(L, i, lua_tostring(L, lua_upvalueindex(1)));
    line += function.empty() ? inspect(L, i) : function;
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
    push(L, input);
    lua_pushcclosure(L, print_results, 1);
    lua_insert(L, bottom + 1);
    outcome = state.call(lua_gettop(L) - bottom - 1, 0);
  }
  lua_settop(L, bottom);
  if (!outcome.done)
    reply.error = outcome.interrupted ? stop_text(stop_cause()) : failure_text(state, outcome);
  clear_ctrl_c();
  return reply;
}

}  // namespace springlod::scripting
