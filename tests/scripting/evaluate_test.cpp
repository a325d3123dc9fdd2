// What the prompt does with a chunk of input, without a terminal.

#include <csignal>
#include <string>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/bind/topics.hpp"
#include "scripting/engine/interrupt.hpp"
#include "scripting/engine/repl.hpp"

using namespace springlod;
using namespace springlod::scripting;
using Catch::Matchers::Contains;

namespace {

/// The global `found` as text.
std::string found(ScriptState& state) {
  lua_State* L = state.lua();
  lua_getglobal(L, "found");
  std::string text = luaL_tolstring(L, -1, nullptr);
  lua_pop(L, 2);
  return text;
}

}  // namespace

TEST_CASE("A chunk runs with the globals of the chunks before it") {
  ScriptState state({}, make_api());
  CHECK(evaluate(state, "x = 20").error.empty());
  CHECK(evaluate(state, "found = x + 1").error.empty());
  CHECK(found(state) == "21");
}

TEST_CASE("An expression is evaluated once, and its values are popped from the stack") {
  ScriptState state({}, make_api());
  const int height = lua_gettop(state.lua());
  const Reply reply =
      evaluate(state,
               "(function() found = (found or 0) + 1 return setmetatable({}, {__tostring = "
               "function() return '' end}) end)()");
  CHECK(reply.error.empty());
  CHECK(found(state) == "1");
  CHECK(lua_gettop(state.lua()) == height);
}

TEST_CASE("An incomplete chunk requests more lines, an invalid one does not") {
  ScriptState state({}, make_api());
  for (const char* begun : {"for i = 1, 2 do", "f = function()", "t = {", "s = [[text"})
    CHECK(needs_more_lines(state, begun));
  CHECK_FALSE(needs_more_lines(state, "for for"));
  CHECK_THAT(evaluate(state, "for for").error, Contains("input:1:"));
  CHECK(evaluate(state, "for i = 1, 2 do\nfound = i\nend").error.empty());
  CHECK(found(state) == "2");
}

TEST_CASE("A failed chunk reports the line of the error, and the next one runs") {
  ScriptState state({}, make_api());
  const int height = lua_gettop(state.lua());
  const Reply reply = evaluate(state, "found = 1 error('broken')");
  CHECK(reply.error == "input:1: broken");
  CHECK(evaluate(state, "\nerror(nil)").error == "input:2: nil");
  const Reply unprintable =
      evaluate(state, "setmetatable({}, {__tostring = function() error('mute') end})");
  CHECK_THAT(unprintable.error, Contains("mute"));
  const Reply unprintable_error =
      evaluate(state, "error(setmetatable({}, {__tostring = function() error('mute') end}))");
  CHECK_THAT(unprintable_error.error, Contains("cannot be shown"));
  CHECK(lua_gettop(state.lua()) == height);
  CHECK(evaluate(state, "found = found + 1").error.empty());
  CHECK(found(state) == "2");
}

TEST_CASE("Under verbose, a failed chunk has a traceback") {
  ScriptState state({.verbosity = Verbosity::verbose}, make_api());
  CHECK_THAT(evaluate(state, "error('broken')").error,
             Contains("input:1: broken\nstack traceback:") && Contains("in main chunk"));
}

TEST_CASE("Ctrl-C stops a chunk, also inside pcall, and is cleared afterwards") {
  const InterruptHandler handler;
  ScriptState state({}, make_api());
  // The chunk itself sends the signal, so it arrives while the loop runs.
  lua_register(state.lua(), "press_ctrl_c", [](lua_State*) { return std::raise(SIGINT); });
  const Reply reply =
      evaluate(state, "press_ctrl_c() while true do pcall(function() found = 1 end) end");
  CHECK(reply.error == "interrupted");
  CHECK_FALSE(interrupt_requested());
  CHECK(evaluate(state, "found = 2").error.empty());
  CHECK(found(state) == "2");
}

TEST_CASE("Scripts receive arguments, a failed script reports its line and a traceback") {
  ScriptState state({}, make_api());
  CHECK(
      state.run_text("local a, b = ... found = a .. b .. arg[2] .. #arg", "test", {"1", "2"}).done);
  CHECK(found(state) == "1222");
  const Outcome failed = state.run_text("local x = 1\nerror('broken')", "test", {});
  CHECK_FALSE(failed.done);
  CHECK_FALSE(failed.interrupted);
  CHECK_THAT(failed.message, Contains("test") && Contains(":2: broken"));
  CHECK_THAT(failed.traceback, Contains("stack traceback"));
  CHECK_FALSE(state.run_text("for for", "test", {}).done);
  CHECK_FALSE(state.run_file("no such file.lua", {}).done);
}
