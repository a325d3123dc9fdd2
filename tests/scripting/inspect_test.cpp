// Display of values at the prompt.

#include "scripting/engine/inspect.hpp"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/bind/tables/values.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/state.hpp"

using namespace springlod;
using namespace springlod::scripting;

namespace {

std::string shown(const std::string& expression, const InspectOptions& options = {}) {
  ScriptState state({}, make_api());
  lua_State* L = state.lua();
  REQUIRE(luaL_dostring(L, ("return " + expression).c_str()) == LUA_OK);
  const int height = lua_gettop(L);
  std::string text = inspect(L, -1, options);
  CHECK(lua_gettop(L) == height);
  return text;
}

}  // namespace

TEST_CASE("Plain values are shown by tostring, text is quoted only in tables") {
  CHECK(shown("nil") == "nil");
  CHECK(shown("true") == "true");
  CHECK(shown("1.5") == "1.5");
  CHECK(shown("'two words'") == "two words");
  CHECK(shown("{'two words'}") == "{\"two words\"}");
  CHECK(shown(R"({'a "quote", a \\ and\na line'})") == R"({"a \"quote\", a \\ and\na line"})");
}

TEST_CASE("Tables are shown with the list first, then keys in order, nested") {
  CHECK(shown("{}") == "{}");
  CHECK(shown("{3, 2, 1}") == "{3, 2, 1}");
  CHECK(shown("{b = 1, a = {c = 2}, 7}") == "{7, a = {c = 2}, b = 1}");
  CHECK(shown("{[10] = 'x', [2.5] = 'y', [true] = 'z', ['two words'] = 1, ['2nd'] = 2}") ==
        "{[2.5] = \"y\", [10] = \"x\", [\"2nd\"] = 2, [\"two words\"] = 1, [true] = \"z\"}");
}

TEST_CASE("Recursive and deeply nested tables are truncated") {
  CHECK(shown("(function() local t = {} t.self = t return t end)()") == "{self = {...}}");
  CHECK(shown("{{{1}}}", {.depth = 2}) == "{{{...}}}");
  // A table that occurs twice is not a cycle.
  CHECK(shown("(function() local t = {1} return {t, t} end)()") == "{{1}, {1}}");
}

TEST_CASE(
    "Long tables are truncated with the count of hidden entries, wide ones use several lines") {
  const InspectOptions few{.entries = 2};
  CHECK(shown("{1, 2, 3, 4, 5}", few) == "{1, 2, ... 3 more}");
  CHECK(shown("{a = 1, b = 2, c = 3}", few) == "{a = 1, b = 2, ... 1 more}");
  CHECK(shown("{alpha = {1, 2, 3}, beta = 2}", {.line_width = 20}) ==
        "{\n  alpha = {1, 2, 3},\n  beta = 2,\n}");
}

TEST_CASE("A user's __tostring is called, and may fail") {
  CHECK(shown("setmetatable({}, {__tostring = function() return 'mine' end})") == "mine");
  ScriptState state({}, make_api());
  const Outcome outcome = state.run_text(
      "local s = require 'springlod'\n"
      "s.inspect(setmetatable({}, {__tostring = function() error('broken') end}))",
      "test", {});
  CHECK_FALSE(outcome.done);
  CHECK_THAT(outcome.message, Catch::Contains("broken"));
}

TEST_CASE("print_inspected lets tostring show a table as inspect does") {
  ScriptState state({}, make_api());
  lua_State* L = state.lua();
  const auto scenario = [](const char* name) {
    auto made = std::make_shared<sim::Scenario>();
    made->name = name;
    return std::shared_ptr<const sim::Scenario>(std::move(made));
  };
  push(L, std::vector{scenario("drop"), scenario("throw")});
  print_inspected(L);
  const std::string text = inspect(L, -1);
  CHECK(text == "{Scenario drop: 1 s, 0 obstacles, Scenario throw: 1 s, 0 obstacles}");
  CHECK(luaL_tolstring(L, -1, nullptr) == text);
  lua_pop(L, 1);
  lua_pushinteger(L, 3);
  lua_setfield(L, -2, "more");
  const std::string with_field = inspect(L, -1);
  CHECK(luaL_tolstring(L, -1, nullptr) == with_field);
  lua_pop(L, 1);
  // Of other tables, the text is that which they have.
  CHECK(shown("setmetatable({1}, {__tostring = function() return 'one' end})") == "one");
  push(L, std::vector{1, 2});
  CHECK_THAT(luaL_tolstring(L, -1, nullptr), Catch::StartsWith("table: "));
}
