// springlod pareto.

#include <map>

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;
namespace fs = std::filesystem;

namespace {

const char* const kScenario =
    "return {name = 'drop', duration = 0.2, throw = {velocity = {1, 0, 0}},\n"
    "        obstacles = {{plane = {0, 0, 1, -0.05}, name = 'floor', friction = 0.4}}}\n";

std::vector<std::string> arguments(const TemporaryFolder& scratch,
                                   const std::vector<std::string>& more = {}) {
  std::vector<std::string> all{
      "pareto", (scratch / "bar.glb").string(), "--scenario", (scratch / "drop.lua").string(),
      "--out",  (scratch / "out").string(),     "--quick"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

void make_asset(const TemporaryFolder& scratch) {
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.34", "--keep", "0.5,0.3"});
  spit(scratch / "drop.lua", kScenario);
}

std::map<std::string, Row> by_variant(const fs::path& path) {
  std::map<std::string, Row> rows;
  for (const Row& row : rows_of(slurp(path))) rows[row.at("variant")] = row;
  return rows;
}

/// The output of `script`, which can require the modules of the stock commands.
std::string printed(const std::string& script) {
  const Ran ran = springlod_run({"-e", script});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  return ran.out;
}

}  // namespace

TEST_CASE("pareto --quick writes charts, fronts and tables, and does not repeat kept runs",
          "[long]") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran ran = springlod_run(arguments(scratch));
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const fs::path out = scratch / "out";

  // Two groupings x two calibrations x two levels, in both precisions and with both contacts, and
  // the base in both precisions.
  const auto points = by_variant(out / "points.csv");
  REQUIRE(points.size() == 2 + 2 * 2 * 2 * 2 * 2);
  const auto timings = by_variant(out / "timings.csv");
  CHECK(timings.size() == points.size());
  for (const auto& [name, row] : points) {
    CAPTURE(name);
    for (const char* error : {"frequencies", "loads", "surface"}) {
      const std::string column = error;
      CHECK(number(row, column + " low [%]") <= number(row, column + " [%]"));
      CHECK(number(row, column + " [%]") <= number(row, column + " high [%]"));
      CHECK((number(row, column + " [%]") > 0) ==
            (row.at("level") != "0" || (column == "surface" && row.at("precision") == "single")));
    }
    const Row& times = timings.at(name);
    CHECK(number(times, "cost [s/s]") > 0);
    CHECK(number(times, "cost / base low") <= number(times, "cost / base"));
    CHECK(number(times, "cost / base") <= number(times, "cost / base high"));
  }
  // Elastic errors depend neither on the integrator nor on contact; single precision is close to
  // double.
  const Row& plain = points.at("standard-none-none-1-symplectic_euler-double-nodes");
  const Row& single = points.at("standard-none-none-1-symplectic_euler-single-nodes");
  CHECK(plain.at("paper") == "LOD-1");
  CHECK(single.at("paper").empty());
  CHECK(plain.at("frequencies [%]") == single.at("frequencies [%]"));
  CHECK(number(single, "surface [%]") == Approx(number(plain, "surface [%]")).epsilon(1e-3));
  CHECK(plain.at("nodes") ==
        points.at("compact-none-none-1-symplectic_euler-double-nodes").at("nodes"));
  CHECK(number(plain, "ensemble floor [m]") > 0);
  const Row& surface = points.at("standard-none-none-1-symplectic_euler-double-surface");
  CHECK(surface.at("label") == "standard L1 surface");
  CHECK(surface.at("paper").empty());
  CHECK(surface.at("frequencies [%]") == plain.at("frequencies [%]"));
  CHECK(surface.at("surface [%]") != plain.at("surface [%]"));

  for (const char* error : {"frequencies", "loads", "surface", "ensemble"}) {
    CAPTURE(error);
    double cost = 0;
    double least = 1e300;
    const auto front = rows_of(slurp(out / (std::string(error) + "-front.csv")));
    REQUIRE(!front.empty());
    CHECK_THAT(slurp(out / "index.html"), Contains("the Pareto front"));
    for (const Row& row : front) {
      const auto value = [&](const std::string& column) {
        const Row& from = points.at(row.at("variant"));
        return number(from, column);
      };
      const double x = number(timings.at(row.at("variant")), "cost / base");
      const double y = value(std::string(error) + (error[0] == 'e' ? " [m]" : " [%]"));
      CHECK(x > cost);
      CHECK(y < least);
      cost = x;
      least = y;
    }
    CHECK((fs::exists(out / (std::string(error) + ".svg")) ||
           ran.err.find("gnuplot") != std::string::npos));
    CHECK_THAT(slurp(out / (std::string(error) + ".gp")),
               Contains("Pareto front") && Contains("the paper"));
  }
  CHECK(fs::exists(out / "models/compact-none-modes-seed-1.glb"));
  CHECK_THAT(slurp(out / "command.txt"), Contains("springlod --seed 1 pareto ") &&
                                             Contains("--scenario ") && Contains("--quick"));

  // Stored models, runs and times reproduce the same files.
  const std::string before = slurp(out / "timings.csv");
  REQUIRE(springlod_run(arguments(scratch, {"-q"})).exit_code == 0);
  CHECK(slurp(out / "timings.csv") == before);
  const Ran other = springlod_run(arguments(scratch, {"--starts", "6"}));
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.err, Contains("holds results of the arguments") && Contains("another folder"));
}

TEST_CASE("pareto runs the integrators that it is asked for") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran more = springlod_run(arguments(
      scratch, {"-q", "--integrators", "symplectic_euler,xpbd", "--precisions", "double",
                "--groupings", "standard", "--contacts", "nodes", "--errors", "frequencies"}));
  CAPTURE(more.err);
  REQUIRE(more.exit_code == 0);
  const auto added = by_variant(scratch / "out/points.csv");
  CHECK(added.size() == 2 * (1 + 2 * 2));
  CHECK(added.at("standard-none-none-2-xpbd-double-nodes").at("label") == "standard L2 XPBD");
  CHECK(added.at("standard-none-none-2-xpbd-double-nodes").at("surface [%]").empty());
}

TEST_CASE(
    "pareto skips levels that cannot be built, with the reason, wrong use fails before any run") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran ran = springlod_run(arguments(
      scratch,
      {"--groupings", "compact", "--borders", "none,strong", "--calibrations", "none", "--errors",
       "frequencies", "--precisions", "double", "--contacts", "surface", "--keep", "0.2"}));
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("failed levels and measurements: 1 (see left-out.csv)"));
  CHECK_THAT(slurp(scratch / "out/left-out.csv"),
             Contains("compact-strong-none,levels,") && Contains("border nodes"));
  CHECK(by_variant(scratch / "out/points.csv").size() == 2);

  const auto refused = [&](const std::vector<std::string>& more, int code, const char* reason) {
    const Ran wrong = springlod_run(arguments(scratch, more));
    CAPTURE(wrong.err);
    CHECK(wrong.exit_code == code);
    CHECK_THAT(wrong.err, Contains(reason) && !Contains("traceback"));
  };
  refused({"--groupings", "stndard"}, 2, "must be one of standard, priority,");
  refused({"--starts", "4"}, 2, "must be an integer of 5 to 1000000");
  refused({"--out", (scratch / "other").string(), "--integrators", "xpbd", "--precisions", "single",
           "--errors", "loads"},
          1, "only symplectic_euler supports single precision");
  spit(scratch / "drop.lua", "return {duratoin = 1}");
  refused({}, 1, "did you mean 'duration'?");
  spit(scratch / "drop.lua", kScenario);
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.25", "--levels", "0"});
  refused({"--out", (scratch / "third").string()}, 1, "--keep 0.45,0.2");
}

TEST_CASE("a single start can be run, and a level's trajectory compared with its base's") {
  const Ran ran = springlod_run({"-e", R"(local s = require "springlod"
    local grid = s.grid{cell = 0.1, size = {3, 3, 8}, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = "2 ms"}}}
    local chain = s.simplify(s.lattice(grid), {levels = 2})
    local scene = s.scenario{duration = 0.3, throw = {velocity = {2, 0, 0}},
      obstacles = {{plane = {0, 0, 1, -0.1}, friction = 0.5}}}
    local far = s.ensemble(chain[1], scene, {starts = 3, jitter = 0.1, seed = 4})
    for number = 1, 3 do
      local run = s.run(chain[1], s.jittered(scene, chain[0],
        {number = number, jitter = 0.1, seed = 4}), {ledger = false})
      local x = 0
      for i, p in ipairs(run.final.x) do x = x + chain[1]:node(i).mass * p[1] end
      x = x / chain[1].mass - chain[0].center[1]
      assert(math.abs(math.abs(x) - far[number].distance) < 1e-3, number)
    end
    local base = s.run(chain[0], scene)
    local list = s.deviation(s.run(chain[2], scene), base)
    assert(#list == base.frame_count and list[1].surface < 1e-12)
    assert(list[#list].surface > 1e-4 and list[#list].shape <= list[#list].surface)
    assert(s.deviation(base, base)[#list].surface == 0)
    assert(base.planning_seconds >= 0 and base.planning_seconds <= base.wall_seconds)
    assert(base.processor_seconds > 0)
    print(pcall(s.deviation, base, s.run(chain[1], scene)))
    print(pcall(s.jittered, scene, chain[0], {jitter = 1}))
    print(pcall(s.jittered, scene, chain[0], {number = 0})))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("level 0") && Contains("jitter must be in [0, 1)") &&
                          Contains("number must be a whole number of 1 to"));
}

TEST_CASE("a front has the non-dominated points, medians of few numbers have sign-test intervals") {
  CHECK(printed(R"(local front = require("studies.pareto.front")({{x = 2, y = 1}, {x = 1, y = 3},
    {x = 1, y = 2}, {x = 3, y = 0.995}, {x = 4, y = 0.5}, {x = 1.5, y = 2.5},
    {x = 5, y = 0.02}, {x = 6, y = 0}}, 0.1)
    for _, p in ipairs(front) do print(p.x, p.y) end)") == "1\t2\n2\t1\n4\t0.5\n5\t0.02\n");
  // Sign test: the second to the eighth of nine numbers contain the median in 96 % of all cases.
  CHECK(printed(R"(local intervals = require "lib.intervals"
    local m = intervals.median{9, 1, 8, 2, 7, 3, 6, 4, 5}
    print(m.value, m.low, m.high)
    local few = intervals.median{4, 1, 2, 3}
    print(few.value, few.low, few.high)
    local mean = intervals.mean{1, 2, 6}
    print(mean.value, mean.low, mean.high)
    local resampled = intervals.mean{1, 2, 3, 4, 5, 6}
    print(resampled.value, resampled.low > 1, resampled.high < 6))") ==
        "5.0\t2\t8\n2.5\t1\t4\n3.0\t1\t6\n3.5\ttrue\ttrue\n");
}
