// Calibrated levels and their certificates in scripts and in the accuracy study.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Contains;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

/// Runs `body` with `base`, a bar of 4 x 3 x 9 cells.
Ran with_bar(const std::string& body) {
  return springlod_run({"-e", R"(local s = require "springlod"
    local grid = s.grid{cell = 0.1, size = {4, 3, 9}, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = "2 ms"}}}
    local base = s.lattice(grid)
    )" + body});
}

}  // namespace

TEST_CASE("a script calibrates a chain and reads its certificate") {
  const Ran ran = with_bar(R"(
    local chain = s.simplify(base, {keep = {0.5}, grouping = "compact", calibrate = "modes",
      calibration = {tolerance = 0.01, iterations = 20, patches = 30, modes = 12,
        anchored = function(node) return node.z < 0.01 end}})
    assert(chain[1].node_count == math.floor(0.5 * base.node_count + 0.5))
    local held = s.info(chain).levels[2].certificate
    assert(#held.frequencies == 12 and held.f1_10_error < 0.01, held.f1_10_error)
    assert(held.cost_ratio < 0.6 and held.tolerance == 0.01)
    assert(s.info(chain).levels[1].certificate == nil)
    local free = s.info(s.certify(chain, {modes = 5, held_out_loads = 3, seed = 2})).levels[2]
    assert(#free.certificate.frequencies == 5 and #free.certificate.loads == 15)
    local modes_alone = s.simplify(base, {levels = 1, calibrate = "modes",
      calibration = {targets = "modes", iterations = 2}})
    assert(modes_alone[1].node_count > 0)
    print("calibrated"))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("calibrated"));
}

TEST_CASE("calibration refuses invalid options with a reason") {
  const auto refusal = [](const std::string& options) {
    const Ran ran = with_bar("s.simplify(base, {" + options + "})");
    CHECK(ran.exit_code == 1);
    return ran.err;
  };
  CHECK_THAT(refusal("calibrate = 'full'"), Contains("none") && Contains("modes"));
  CHECK_THAT(refusal("keep = {0.2, 0.5}"), Contains("must fall"));
  CHECK_THAT(refusal("keep = {0.5}, levels = 2"), Contains("leave one out"));
  CHECK_THAT(refusal("calibrate = 'modes', mass = 'proximity'"), Contains("leave out mass"));
  CHECK_THAT(refusal("keep = {0.5}, grouping = {{1, 2}}"),
             Contains("keep cannot be met by the groups of a script"));
  CHECK_THAT(refusal("grouping = 'compact', grading = 2"), Contains("must be from 0 to 1"));
  CHECK_THAT(refusal("grouping = 'metis', border = 'weak'"), Contains("has no border rules"));
  CHECK_THAT(refusal("calibrate = 'modes', calibration = {target = 'modes'}"), Contains("targets"));
}

TEST_CASE("springlod accuracy compares methods", "[long]") {
  const TemporaryFolder scratch;
  const std::string folder = (scratch / "accuracy").string();
#ifdef SPRINGLOD_HAS_METIS
  const std::string last = "METIS plain";
#else
  const std::string last = "compact plain";
#endif
  const Ran ran = springlod_run({"accuracy", folder, "--quick", "-q", "--methods",
                                 "plain merging,compact calibrated,lattice refill," + last});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("compact calibrated") && Contains("lattice refill"));
  CHECK_THAT(slurp(scratch / "accuracy" / "levels.csv"), Contains("sphere," + last + ",1"));
  CHECK_THAT(slurp(scratch / "accuracy" / "methods.csv"), Contains("held-out loads worst"));
  const Ran nothing = springlod_run({"accuracy", folder, "--bodies", "teapot"});
  CHECK(nothing.exit_code == 2);
  CHECK_THAT(nothing.err, Contains("must be one of sphere, rods"));
}

TEST_CASE("springlod accuracy charts the errors of levels against their cost", "[long]") {
  const TemporaryFolder scratch;
  const std::string folder = (scratch / "accuracy").string();
  const Ran ran = springlod_run({"accuracy", folder, "--trade-off", "--quick", "-q"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(slurp(scratch / "accuracy" / "levels.csv"),
             Contains("sphere,compact calibrated,1,6,28"));
  CHECK_THAT(slurp(scratch / "accuracy" / "trade-off.svg"), Contains("held-out loads, calibrated"));
}
