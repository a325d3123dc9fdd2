// Help texts made from descriptions.

#include "scripting/engine/help.hpp"

#include <algorithm>
#include <memory>
#include <sstream>
#include <string>

#include <catch2/catch.hpp>
#include <lua.hpp>

#include "base/error.hpp"
#include "scripting/bind/topics.hpp"
#include "scripting/engine/state.hpp"

using namespace springlod;
using namespace springlod::scripting;
using Catch::Matchers::Contains;

namespace {

FunctionEntry sample() {
  return {.name = "soften",
          .group = "Materials",
          .summary = "Makes a material softer.",
          .arguments = {{.name = "material", .type = "Material", .help = "what is made softer"}},
          .options = {{.name = "young",
                       .type = "quantity",
                       .dimension = Dimension::pressure,
                       .fallback = "1e5",
                       .help = "modulus afterwards"},
                      {.name = "way",
                       .type = "one of",
                       .fallback = "\"slow\"",
                       .help = "how",
                       .choices = {"way", {{"slow"}, {"fast"}}}}},
          .returns = "Material",
          .errors = "A material of stone.",
          .example = "soften(stone, {young = \"1 MPa\"})"};
}

Api sample_api() {
  Api api;
  api.add(sample());
  api.add(RecordEntry{.name = "Stone",
                      .summary = "What is hard.",
                      .fields = {{.name = "weight", .type = "number", .help = "how heavy"}},
                      .example = "{weight = 3}"});
  return api;
}

}  // namespace

TEST_CASE("A signature shows arguments, options and the result") {
  CHECK_THAT(signature(sample()),
             Contains("soften(material, {young, way") && Contains("-> Material"));
  FunctionEntry method = sample();
  method.owner = "Rock";
  method.options.clear();
  CHECK_THAT(signature(method), Contains("rock:soften(material) -> Material"));
}

TEST_CASE("A parameter is shown with its unit, its default or its choices") {
  const FunctionEntry entry = sample();
  CHECK(type_and_default(entry.arguments[0]) == "Material");
  CHECK_THAT(type_and_default(entry.options[0]), Contains("quantity in Pa") && Contains("1e5"));
  CHECK_THAT(type_and_default(entry.options[1]),
             Contains("slow") && Contains("fast") && Contains("default \"slow\""));
}

TEST_CASE("The help of a function has all fields of its description, wrapped to the line width") {
  const std::string text = help_for(sample());
  for (const char* part : {"Makes a material softer.", "what is made softer", "modulus afterwards",
                           "A material of stone.", "soften(stone, {young = \"1 MPa\"})"})
    CHECK_THAT(text, Contains(part));
  FunctionEntry wordy = sample();
  wordy.summary.clear();
  for (int i = 0; i < 60; ++i) wordy.summary += "words ";
  std::istringstream lines(help_for(wordy));
  for (std::string line; std::getline(lines, line);) CHECK(line.size() <= 88);
}

TEST_CASE("Help by name finds functions and records, errors suggest similar names") {
  const Api api = sample_api();
  CHECK(help_for(api, "soften") == help_for(api.functions().front()));
  CHECK(help_for(api, "Stone") == help_for(api.records().front()));
  CHECK_THROWS_AS(help_for(api, "sofen"), InputError);
  CHECK_THROWS_WITH(help_for(api, "sofen"), Contains("did you mean 'soften'?"));
  CHECK_THROWS_AS(help_for(api, "Stone:weight"), InputError);
}

TEST_CASE("All that the overview lists has help") {
  const std::unique_ptr<Api> api = make_api();
  std::istringstream lines(overview(*api));
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  ") || line[2] == ' ') continue;
    const std::string name = line.substr(2, line.find(' ', 2) - 2);
    CAPTURE(name);
    CHECK_NOTHROW(help_for(*api, name));
    ++count;
  }
  CHECK(count > 60);
}

TEST_CASE("Overview and Markdown list everything") {
  const Api api = sample_api();
  CHECK_THAT(overview(api), Contains("Materials") && Contains("soften"));
  const std::string page = api_markdown(api);
  for (const char* part : {"soften", "Makes a material softer.", "`young`", "Stone", "how heavy"})
    CHECK_THAT(page, Contains(part));
}

TEST_CASE("Help on a Lua value is the help of its function, type or name") {
  ScriptState state({}, make_api());
  lua_State* L = state.lua();
  const auto help_on = [&](const std::string& expression) {
    REQUIRE(luaL_dostring(L, ("s = require 'springlod' return " + expression).c_str()) == LUA_OK);
    std::string text = help_at(L, -1, state.api());
    lua_pop(L, 1);
    return text;
  };
  CHECK(help_on("s.voxelize") == help_for(*state.api().find_function("voxelize")));
  CHECK(help_on("'voxelize'") == help_on("s.voxelize"));
  CHECK(help_on("s.model{nodes = {{0, 0, 0, mass = 1}}}") ==
        help_for(*state.api().find_type("Model")));
  CHECK(help_on("s.material_presets") == help_on("'s.material_presets'"));
  CHECK_THAT(help_on("s.material_presets"),
             Contains("s.material_presets: list of tables\n\n  mat"));
  CHECK_THAT(help_on("s.choices"), Contains("s.choices: table"));
  CHECK(help_on("s.choices.border") == help_on("'choices.border'"));
  CHECK_THAT(help_on("'seed'"), Contains("s.seed: integer"));
  CHECK_THROWS_WITH(help_on("{}"), Contains("there is no help on a table"));
}

TEST_CASE("Help on nil is an error, not the list of all names") {
  ScriptState state({}, make_api());
  const Outcome outcome = state.run_text("local t = {} help(t.blorbs)", "test", {});
  CHECK_FALSE(outcome.done);
  CHECK_THAT(outcome.message, Contains("help: the value is nil") && Contains("help() lists"));
}

TEST_CASE("The check of descriptions reports missing entries") {
  Api api;
  api.add(FunctionEntry{.name = "mute", .options = {{.name = "x", .type = "number"}}});
  const std::vector<std::string> missing = undocumented(api);
  for (const char* hole : {"mute: summary", "mute: returns", "mute: binding", "mute.x: help"})
    CHECK(std::count(missing.begin(), missing.end(), hole) == 1);
  CHECK(undocumented(*make_api()).empty());
}
