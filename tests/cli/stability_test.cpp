#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

void make_asset(const TemporaryFolder& scratch) {
  make_bar_asset(scratch / "bar.glb", 3,
                 {"--cell", "0.5", "--lattice", "corners", "--levels", "1"});
}

std::vector<std::string> arguments(const TemporaryFolder& scratch, const std::string& out,
                                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{"stability",
                               (scratch / "bar.glb").string(),
                               "--out",
                               (scratch / out).string(),
                               "--ratios",
                               "1,100",
                               "--steps",
                               "0.9,1.2",
                               "--implicit-steps",
                               "0.05",
                               "--sweep-steps",
                               "0.02"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

}  // namespace

TEST_CASE(
    "stability writes map, bodies, timings and picture, identical for any number of threads") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran ran = springlod_run(arguments(scratch, "one"));
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("stiff part: the half beyond the center of mass along x") &&
                          Contains("projective_dynamics") &&
                          Contains("cheapest run with the verdict \"stable\"") &&
                          Contains("40 points:"));
  const std::string map = slurp(scratch / "one/map.csv");
  CHECK_THAT(map, StartsWith("level,nodes,springs,integrator,iterations,ratio,step,limit,"));
  // 2 levels, 2 ratios, 3 explicit schemes of 2 steps, 4 others of one.
  CHECK(std::count(map.begin(), map.end(), '\n') == 1 + 2 * 2 * (3 * 2 + 4));
  CHECK_THAT(map, Contains(",diverged,") && !Contains("wall") && !Contains("nan"));
  CHECK_THAT(slurp(scratch / "one/timings.csv"), Contains("wall_seconds"));
  CHECK_THAT(slurp(scratch / "one/map.gp"), Contains("'1 sweep'") && Contains("'10 iterations'"));
  for (const char* picture : {"map.svg", "map.png"})
    CHECK((fs::exists(scratch / "one" / picture) || ran.err.find("gnuplot") != std::string::npos));

  std::vector<std::string> single = arguments(scratch, "two");
  single.insert(single.begin(), {"--threads", "1"});
  REQUIRE(springlod_run(single).exit_code == 0);
  for (const char* name : {"map.csv", "bodies.csv", "map.gp"}) {
    CAPTURE(name);
    CHECK(slurp(scratch / "one" / name) == slurp(scratch / "two" / name));
  }
}

TEST_CASE("stability recommends stable runs only") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto mapped = [&](const std::string& integrators) {
    const Ran ran =
        springlod_run({"stability", (scratch / "bar.glb").string(), "--out",
                       (scratch / "out").string(), "--ratios", "1", "--levels", "0",
                       "--integrators", integrators, "--sweep-steps", "0.002", "--steps", "0.9"});
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    return ran.out.substr(ran.out.find("cheapest run"));
  };
  // Its error is small, but it loses energy.
  CHECK_THAT(mapped("xpbd"), Contains("none") && Contains("1 points: 1 drifting"));
  CHECK_THAT(mapped("xpbd,symplectic_euler"), Contains("symplectic_euler"));
}

TEST_CASE("stability reports invalid options and assets in one line") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto refused = [&](const std::vector<std::string>& more, int code,
                           const std::string& reason) {
    const Ran ran = springlod_run(arguments(scratch, "out", more));
    CAPTURE(ran.err, reason);
    CHECK(ran.exit_code == code);
    CHECK_THAT(ran.err, Contains(reason) && !Contains("traceback"));
  };
  refused({"--levels", "7"}, 1, "levels: 7 is not there; the chain has 0 to 1");
  refused({"--integrators", "verlet"}, 2, "velocity_verlet");
  refused({"--ratios", "1,-3"}, 2, "'-3' must be a number above 0");
  refused({"--absolute-steps", "1kg"}, 2, "--absolute-steps");
  refused({"--periods", "none"}, 2, "--periods");
  spit(scratch / "bar.glb", "no asset");
  refused({}, 1, "cannot map");
}

TEST_CASE("stability reports the mechanism of a bar one cell thick and does not run it") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 6, {"--cell", "1", "--lattice", "centers", "--levels", "0"});
  const Ran ran = springlod_run(arguments(scratch, "out"));
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("nothing could be run") && Contains("mechanism"));
  CHECK_THAT(slurp(scratch / "out/map.csv"), Contains(",mechanism,"));
}

TEST_CASE("a script reads which wall a node passed through, where and when") {
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    local m = s.model{nodes = {{0, 0, 0, mass = 1, contact_area = 1}, {1, 0, 0, mass = 1, contact_area = 1}},
                      springs = {{1, 2, k = 100}}}
    local scene = {gravity = {0, 0, 0}, duration = 0.1, throw = {velocity = {100, 0, 0}},
                   obstacles = {{name = "glass", box = {center = {3, 0, 0}, size = {0.01, 5, 5}}}}}
    local ok, failure = pcall(s.run, m, scene, {step = 1e-3})
    print(ok, failure.kind, failure.obstacle, failure.node, failure.time > 0.019)
    print(failure.message))"});
  CAPTURE(ran.err, ran.out);
  CHECK_THAT(ran.out, StartsWith("false\ttunnelled\tglass\t2\ttrue\n"));
  CHECK_THAT(ran.out, Contains("take a step below"));
}
