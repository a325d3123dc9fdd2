// Suggestions for mistyped names, and completion at the prompt.

#include <algorithm>
#include <string>
#include <vector>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/bind/topics.hpp"
#include "scripting/engine/repl.hpp"
#include "scripting/engine/suggest.hpp"

using namespace springlod;
using namespace springlod::scripting;
using Names = std::vector<std::string>;

namespace {

const Names kNames{"levels", "border", "grouping", "keep"};

bool has(const Names& names, const std::string& name) {
  return std::count(names.begin(), names.end(), name) == 1;
}

}  // namespace

TEST_CASE("A near name has a small edit distance: insert, delete, substitute, transpose") {
  for (const char* typo : {"levles", "level", "levelss", "lefels", "lev"})
    CHECK(nearest_name(typo, kNames) == "levels");
  CHECK(nearest_name("kep", kNames) == "keep");
  CHECK(nearest_name("rnedr", {"render"}) == "render");
  CHECK(nearest_name("border", kNames) == "border");
}

TEST_CASE("A name far from all candidates, or an empty one, has no near name") {
  for (const char* name : {"", "x", "colour", "velsle"}) CHECK(nearest_name(name, kNames).empty());
  CHECK(nearest_name("levels", {}).empty());
  // The first of equals.
  CHECK(nearest_name("cat", {"bat", "hat"}) == "bat");
}

TEST_CASE("Hints suggest the near name and list all names") {
  CHECK(did_you_mean("keeep", kNames) == "; did you mean 'keep'?");
  CHECK(did_you_mean("colour", kNames).empty());
  CHECK(name_hint("keeep", {"keep", "seed"}, "simplify takes") ==
        "; did you mean 'keep'? simplify takes: keep, seed");
  CHECK(name_hint("colour", {"keep", "seed"}, "simplify takes") == "; simplify takes: keep, seed");
  CHECK(comma_list({}).empty());
  CHECK(comma_list({"one"}) == "one");
}

TEST_CASE("A word is completed from globals and keywords, a path from the members of its value") {
  ScriptState state({}, make_api());
  REQUIRE(state
              .run_text("s = require 'springlod'\n"
                        "mine = {inner = {leaf = 1, leave = 2, [3] = 4}}\n"
                        "m = s.model{nodes = {{0, 0, 0, mass = 1}}}",
                        "test", {})
              .done);
  CHECK(completions(state, "mi").names == Names{"mine"});
  CHECK(completions(state, "print(mine.inner.lea").names == Names{"leaf", "leave"});
  CHECK(completions(state, "mine.").names == Names{"inner"});
  CHECK(has(completions(state, "x = whi").names, "while"));
  CHECK(completions(state, "s.vox").names == Names{"voxelize"});
  CHECK(has(completions(state, "m:node").names, "node"));
  CHECK(has(completions(state, "m:").names, "springs"));
  CHECK(has(completions(state, "m.node_").names, "node_count"));
  // After a dot fields, after a colon methods; a method after a dot turns the dot into a colon.
  CHECK_FALSE(has(completions(state, "m.").names, "springs"));
  CHECK_FALSE(has(completions(state, "m:").names, "node_count"));
  CHECK_FALSE(completions(state, "m.node_").colon);
  const Completions method = completions(state, "m.springs");
  CHECK((method.colon && has(method.names, "springs")));
  CHECK(completions(state, "m.nothing").names.empty());
  CHECK_FALSE(completions(state, "m.nothing").colon);
  CHECK(has(completions(state, "").names, "s"));
}

TEST_CASE("An unknown path has no completions, and no metamethod runs") {
  ScriptState state({}, make_api());
  REQUIRE(state
              .run_text("trap = setmetatable({}, {__index = function() touched = true end})\n"
                        "number = 3",
                        "test", {})
              .done);
  const int height = lua_gettop(state.lua());
  for (const char* text : {"trap.x.", "nothing.here.", "number.", "trap.inner.le", "1.5."})
    CHECK(completions(state, text).names.empty());
  CHECK(lua_gettop(state.lua()) == height);
  lua_getglobal(state.lua(), "touched");
  CHECK(lua_isnil(state.lua(), -1));
}

TEST_CASE("In a table of options, the keys that are not there yet are completed") {
  ScriptState state({}, make_api());
  REQUIRE(state.run_text("s = require 'springlod'", "test", {}).done);
  const Completions key = completions(state, "s.simplify(m, {lev");
  CHECK(key.names == Names{"levels"});
  CHECK(key.ending == " = ");
  CHECK(has(completions(state, "s.simplify(m, {levels = 2, ").names, "border"));
  CHECK_FALSE(has(completions(state, "s.simplify(m, {levels = 2, ").names, "levels"));
  // Over several lines, after strings and comments with brackets, and through calls as arguments.
  CHECK(
      completions(state, "x = s.simplify(s.lattice(g, {style = 'a)'}), -- {(\n  {\n  grou").names ==
      Names{"grouping"});
  // Of records: as an argument, in a list, in a table by name.
  CHECK(completions(state, "s.scenario{dur").names == Names{"duration"});
  CHECK(completions(state, "s.scenario{obstacles = {{pla").names == Names{"plane"});
  CHECK(completions(state, "s.voxelize(mesh, {materials = {rod = {you").names == Names{"young"});
  // A value is not a key.
  CHECK(completions(state, "s.simplify(m, {levels = 2 + lev").names.empty());
  CHECK(completions(state, "s.simplify(m, {levels = s.vox").names == Names{"voxelize"});
  CHECK(completions(state, "s.simplify(m, {levels == lev").names.empty());
  CHECK(completions(state, "-- s.simplify(m, {lev").names.empty());
}

TEST_CASE("The words of an option are completed, with and without a quote") {
  ScriptState state({}, make_api());
  REQUIRE(state.run_text("s = require 'springlod'", "test", {}).done);
  const Completions word = completions(state, "s.simplify(m, {border = 'wea");
  CHECK(word.names == Names{"weak"});
  CHECK(word.ending == "'");
  CHECK(has(completions(state, "s.simplify(m, {border = ").names, "\"weak\""));
  CHECK(completions(state, "s.simplify(m, {guards = fa").names == Names{"false"});
  CHECK(completions(state, "help('simpl").names == Names{"simplify"});
  CHECK(completions(state, "help 'simpl").names == Names{"simplify"});
}
