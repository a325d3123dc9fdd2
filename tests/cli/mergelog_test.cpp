// `springlod mergelog` and s.merge_log.

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::source_folder;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("mergelog reports where to stop and writes tables, charts and a picture", "[long]") {
  const TemporaryFolder scratch;
  const auto asset = scratch / "bar.glb";
  make_bar_asset(asset, 4, {"--cell", "0.25", "--levels", "1"});
  const auto run = [&](const std::string& folder, std::vector<std::string> options) {
    options.insert(options.begin(), {"mergelog", asset.string(), "--quick", "--out",
                                     (scratch / folder).string(), "-q"});
    return springlod_run(options);
  };
  const Ran first = run("first", {"--threads", "1"});
  CAPTURE(first.err);
  REQUIRE(first.exit_code == 0);
  CHECK_THAT(first.out,
             Contains("kept") && Contains("costliest merge") && Contains("f1..10 within 5 %"));
  for (const char* file : {"errors.svg", "errors.png", "costs.svg", "costs.png", "where.png",
                           "answers.csv", "index.html"})
    CHECK(std::filesystem::exists(scratch / "first" / file));
  // Costs are shares of the error of a level: those of all its merges are 100 %.
  const std::string costs = slurp(scratch / "first/costs.csv");
  const std::size_t last = costs.rfind("%\",100,");
  REQUIRE(last != std::string::npos);
  CHECK(std::stod(costs.substr(last + 7)) == Approx(100).margin(1));
  CHECK_THAT(slurp(scratch / "first/index.html"), !Contains("--calibrate runs"));
  CHECK_THAT(slurp(scratch / "first/merges.csv"), Contains("base_nodes") && Contains("default"));

  REQUIRE(run("second", {"--threads", "2"}).exit_code == 0);
  for (const char* file : {"levels.csv", "merges.csv", "answers.csv", "errors.svg"})
    CHECK(slurp(scratch / "first" / file) == slurp(scratch / "second" / file));

  const Ran own = run("own", {"--as-made", "--tolerance", "0.9"});
  CHECK(own.exit_code == 0);
  CHECK_THAT(own.out, Contains("all levels are within tolerance") && !Contains("f1..10 without"));
  const Ran fitted = run("fitted", {"--calibrate", "--steps", "1", "--least", "0.5"});
  CHECK(fitted.exit_code == 0);
  CHECK_THAT(fitted.out, Contains("f1..10 within 0.5 %"));
}

TEST_CASE("mergelog explains a level whose costliest merges cancel the errors of others") {
  const TemporaryFolder scratch;
  const std::string ball = (scratch / "ball.glb").string();
  const std::string samples = (source_folder() / "samples").string();
  REQUIRE(springlod_run({"convert", samples + "/ball.obj", "-o", ball, "--unit", "dm", "--cell",
                         "10cm", "--fast", "--levels", "1", "--materials",
                         samples + "/ball_materials.lua", "-q"})
              .exit_code == 0);
  const auto told = [&](const std::string& least) {
    const Ran ran = springlod_run({"mergelog", ball, "--steps", "1", "--least", least, "--out",
                                   (scratch / least).string(), "-q"});
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    return ran.out;
  };
  CHECK_THAT(told("0.1"), Contains("cancel each other") && Contains("(f1..10), no better"));
  CHECK_THAT(told("0.5"), !Contains("cancel each other") && !Contains("no better"));
}

TEST_CASE("mergelog reports invalid requests") {
  const TemporaryFolder scratch;
  const Ran none = springlod_run({"mergelog", (scratch / "none.glb").string()});
  CHECK(none.exit_code == 1);
  CHECK_THAT(none.err, Contains("mergelog: ") && Contains("none.glb"));

  const auto bare = scratch / "bare.glb";
  make_bar_asset(bare, 2, {"--cell", "0.5", "--levels", "0"});
  const Ran alone =
      springlod_run({"mergelog", bare.string(), "--as-made", "--out", (scratch / "out").string()});
  CHECK(alone.exit_code == 1);
  CHECK_THAT(alone.err, Contains("nothing was merged"));
  const Ran fine = springlod_run(
      {"mergelog", bare.string(), "--least", "0.999", "--out", (scratch / "out").string()});
  CHECK(fine.exit_code == 1);
  CHECK_THAT(fine.err, Contains("fewer nodes than the base"));
}

TEST_CASE("a script reads the costliest merges and builds levels directly from the base") {
  const Ran ran = springlod_run({"-e", R"(local s = require "springlod"
    local grid = s.grid{cell = 0.1, size = {3, 3, 8}, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = "2 ms"}}}
    local base = s.lattice(grid)
    local nested = s.merge_log(s.simplify(base, {levels = 2}), {modes = 4, local_loads = 2})
    assert(nested[2].from == 1 and #nested[2].answers == 4 + 9 + 4)
    local merges, sum = nested[1].merges, 0
    for i, merge in ipairs(merges) do
      assert(i == 1 or merge.frequencies <= merges[i - 1].frequencies)
      sum = sum + merge.frequencies
    end
    assert(math.abs(sum - nested[1].frequency_error) < 1e-9)
    assert(merges[1].material == "bar" and #merges[1].change == #nested[1].answers)
    local held = s.merge_log(s.simplify(base, {levels = 1}), {modes = 2, from_base = true,
      anchored = function(node) return node.z < 0.01 end})
    assert(held[1].frequency_error > 0)
    local straight = s.simplify(base, {keep = {0.5, 0.25}, straight = true})
    local alone = s.simplify(base, {keep = {0.25}})
    assert(s.json(straight:group_map(2)) == s.json(alone:group_map(1)))
    print("logged"))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("logged"));
}
