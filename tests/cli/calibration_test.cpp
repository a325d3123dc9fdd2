// What scripts and convert can ask of calibration.

#include <catch2/catch.hpp>

#include "tests/cli/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

const char* const kBar =
    "local s = require 'springlod'\n"
    "local bar = s.lattice(s.grid{cell = '10 cm', size = {6, 3, 3},\n"
    "  materials = {rubber = {young = '1 MPa'}}, fill = function() return 'rubber' end})\n"
    "local function fit(calibration, more)\n"
    "  local options = {levels = 1, calibrate = 'modes', calibration = calibration}\n"
    "  for key, value in pairs(more or {}) do options[key] = value end\n"
    "  return s.simplify(bar, options)\n"
    "end\n";

}  // namespace

TEST_CASE("scripts name regions that matter, and weights") {
  const Ran ran = springlod_run({"-q", "-e", std::string(kBar) + R"(
    local function foot(node) return node.x < 0.01 end
    local chain = fit{regions = {{nodes = foot, weight = 2, patches = 6}}, mode_weight = 2,
                      load_weight = 0.5, iterations = 3}
    print(#s.info(s.certify(chain, {within = foot})).levels[2].certificate.loads > 9)
    local function refused(calibration)
      local ok, why = pcall(fit, calibration)
      print(ok, tostring(why))
    end
    refused{regions = {{}}}
    refused{regions = {{nodes = {0}}}}
    refused{regions = 3}
    refused{regions = {{nodes = foot}}, targets = "modes"}
    refused{regions = {{nodes = foot}}, anchored = foot}
    refused{load_weight = -2}
    print(pcall(s.certify, chain, {within = {10000}})))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("true\n"));
  for (const char* reason :
       {"calibration: regions[1]: nodes must be given",
        "regions[1]: nodes[1] must be a node number", "regions must be a list of Region tables",
        "left out beside targets = \"modes\"",
        "nodes of region 1 is a border node that is free to move", "load_weight = -2 must be 0 or",
        "certify: within[1] must be a node number"})
    CHECK_THAT(ran.out, Contains(reason));
}
