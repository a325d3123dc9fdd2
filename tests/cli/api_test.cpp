#include <algorithm>
#include <stdexcept>

#include <catch2/catch.hpp>

#include "scripting/engine/call.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/state.hpp"
#include "tests/cli/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;

TEST_CASE("everything a script can reach is described") {
  const auto api = scripting::make_api();
  const std::vector<std::string> missing = scripting::undocumented(*api);
  CAPTURE(missing);
  CHECK(missing.empty());
  CHECK(api->functions().size() > 25);
}

TEST_CASE("the check of descriptions detects missing entries") {
  scripting::Api api;
  api.add(springlod::FunctionEntry{.name = "mute", .options = {{.name = "x", .type = "number"}}});
  const std::vector<std::string> missing = scripting::undocumented(api);
  for (const char* hole : {"mute: summary", "mute: returns", "mute: binding", "mute.x: help"})
    CHECK(std::count(missing.begin(), missing.end(), hole) == 1);
}

TEST_CASE("docs/api.md equals the output of the program") {
  const Ran ran = springlod_run({"-e", "print(require('springlod').api_markdown())"});
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == slurp(std::string(SPRINGLOD_SOURCE_DIR) + "/docs/api.md"));
}

TEST_CASE("every function of the module has help, and only these") {
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    local names = {}
    for name, value in pairs(s) do
      if type(value) == "function" then
        help(value)
        names[#names + 1] = name
      end
    end
    io.stderr:write(#names))"});
  CHECK(ran.exit_code == 0);
  const auto api = scripting::make_api();
  CHECK(ran.err == std::to_string(api->functions().size()));
  for (const auto& entry : api->functions()) CHECK_THAT(ran.out, Contains("s." + entry.name + "("));
}

TEST_CASE("help explains functions, values, types, tables and refuses the rest with near names") {
  CHECK_THAT(springlod_run({"-e", "help()"}).out, Contains("simplify"));
  const Ran record = springlod_run({"-e", "help('Material')"});
  CHECK_THAT(record.out, Contains("quantity in Pa; default 1000000"));
  const Ran value =
      springlod_run({"-e", "help(require('springlod').model{nodes = {{0, 0, 0, mass = 1}}})"});
  CHECK_THAT(value.out, Contains("model:springs() -> list of Spring"));
  const Ran method = springlod_run({"-e", "help('Model:node')"});
  CHECK_THAT(method.out, Contains("model:node(number) -> Node"));
  const Ran unknown = springlod_run({"-e", "help('voxelise')"});
  CHECK(unknown.exit_code == 1);
  CHECK_THAT(unknown.err, Contains("did you mean 'voxelize'?"));
}

TEST_CASE("a binding that reads what is not listed, or not all that is, fails hard") {
  scripting::ScriptState state({}, scripting::make_api());
  const std::vector<scripting::Parameter> listed{{.name = "size"}, {.name = "speed"}};
  scripting::TableReader reader(state.lua(), 0, listed, "test");
  double value = 0;
  CHECK_THROWS_AS(reader.read("colour", value), std::logic_error);
  reader.read("size", value);
  CHECK_THROWS_AS(reader.finish(), std::logic_error);
  reader.read("speed", value);
  CHECK_NOTHROW(reader.finish());
}
