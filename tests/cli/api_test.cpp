#include <catch2/catch.hpp>

#include "scripting/bind/topics.hpp"
#include "scripting/engine/help.hpp"
#include "scripting/engine/state.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

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

TEST_CASE("docs/api.md equals the output of the program") {
  const Ran ran = springlod_run({"-e", "print(require('springlod').api_markdown())"});
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == slurp(test::source_folder() / "docs/api.md"));
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
  CHECK_THAT(record.out, Contains("quantity in Pa, 0.001 Pa to 1e+06 GPa; default 1000000"));
  const Ran value =
      springlod_run({"-e", "help(require('springlod').model{nodes = {{0, 0, 0, mass = 1}}})"});
  CHECK_THAT(value.out, Contains("model:springs() -> list of Spring"));
  const Ran method = springlod_run({"-e", "help('Model:node')"});
  CHECK_THAT(method.out, Contains("model:node(number) -> Node"));
  const Ran unknown = springlod_run({"-e", "help('voxelise')"});
  CHECK(unknown.exit_code == 1);
  CHECK_THAT(unknown.err, Contains("did you mean 'voxelize'?"));
}
