// Stock commands as sweeps: what they leave is the same, however they were run.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_interrupted;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const std::vector<std::string> kOptions{"--ratios",         "1,100", "--steps",       "0.9,1.2",
                                        "--implicit-steps", "0.05",  "--sweep-steps", "0.02"};

class Scratch {
 public:
  Scratch() {
    make_bar_asset(folder_ / "bar.glb", 3,
                   {"--cell", "0.5", "--lattice", "corners", "--levels", "1"});
  }
  Ran run(std::vector<std::string> arguments, const std::vector<std::string>& more = {}) const {
    arguments.insert(arguments.end(), more.begin(), more.end());
    return springlod_run(arguments, "", folder_.path());
  }
  Ran must(const std::vector<std::string>& arguments,
           const std::vector<std::string>& more = {}) const {
    const Ran ran = run(arguments, more);
    CAPTURE(arguments, ran.err, ran.out);
    REQUIRE(ran.exit_code == 0);
    return ran;
  }
  fs::path operator/(const fs::path& name) const { return folder_ / name; }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("A study and a sweep of it leave the same files") {
  const Scratch scratch;
  const Ran direct = scratch.must({"stability", "bar.glb", "--out", "direct"}, kOptions);
  scratch.must({"sweep", "plan", "stability", "--out", "planned", "--", "bar.glb"}, kOptions);
  scratch.must({"sweep", "run", "planned"});
  const Ran merged = scratch.must({"sweep", "merge", "planned"});
  CHECK(merged.out == direct.out);
  for (const char* file : {"map.csv", "bodies.csv", "map.gp", "results.csv", "gaps.csv"}) {
    CAPTURE(file);
    CHECK(slurp(scratch / "direct" / file) == slurp(scratch / "planned" / file));
  }
  // The study removes what only an interrupted one needs.
  CHECK(fs::exists(scratch / "planned/plan.json"));
  for (const char* name : {"plan.json", "results", "logs"})
    CHECK_FALSE(fs::exists(scratch / "direct" / name));
}

TEST_CASE("What is missing of a study is named in its table and on its chart") {
  const Scratch scratch;
  scratch.must({"sweep", "plan", "stability", "--out", "out", "--", "bar.glb"}, kOptions);
  scratch.must({"sweep", "run", "out"});
  fs::remove(scratch / "out/results/0000/0000001.json");
  const Ran merged = scratch.must({"sweep", "merge", "out"});
  CHECK_THAT(merged.err, Contains("1 unit without a result"));
  CHECK_THAT(slurp(scratch / "out/map.gp"), Contains("(1 of 4 results are missing)"));
  CHECK_THAT(slurp(scratch / "out/results.csv"), Contains("missing: not run"));
}

TEST_CASE("A study without any result ends with the reason") {
  const Scratch scratch;
  const Ran ran = scratch.run({"stability", "bar.glb", "--out", "out", "--levels", "7"}, kOptions);
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("levels: 7 is not there; the chain has 0 to 1"));
}

TEST_CASE("An interrupted study continues") {
  const Scratch scratch;
  std::vector<std::string> arguments{"stability",
                                     (scratch / "bar.glb").string(),
                                     "--out",
                                     (scratch / "out").string(),
                                     "--absolute-steps",
                                     "0.1ms"};
  const Ran stopped = springlod_interrupted(arguments, "all of it takes about");
  CAPTURE(stopped.err);
  CHECK(stopped.exit_code == 130);
  CHECK_THAT(stopped.err, Contains("run the same command again to continue"));
  CHECK(fs::exists(scratch / "out/plan.json"));
  CHECK_FALSE(fs::exists(scratch / "out/map.csv"));
}

TEST_CASE("Parts of a stability map are joined to the whole") {
  const Ran ran = springlod_run({"-e", R"(local s = require "springlod"
    local grid = s.grid{cell = 0.1, size = {2, 2, 5}, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = "2 ms"}}}
    local chain = s.simplify(s.lattice(grid), {levels = 1})
    local function rows_of(levels, ratios)
      return s.stability(chain, {levels = levels, ratios = ratios, steps = {0.9, 20},
        integrators = {"symplectic_euler", "xpbd"}, sweep_steps = {0.02}}):rows()
    end
    local parts = {}
    for level = 0, 1 do
      for _, ratio in ipairs{1, 50} do
        for _, row in ipairs(rows_of({level}, {ratio})) do parts[#parts + 1] = row end
      end
    end
    local whole, joined = s.join_stability(rows_of({0, 1}, {1, 50})), s.join_stability(parts)
    for _, name in ipairs{"table", "bodies"} do
      local a, b = s.json((whole[name](whole))), s.json((joined[name](joined)))
      assert(a == b and #a > 100, a .. b)
    end
    print(#parts, tostring(joined) == tostring(whole))
    print(pcall(s.join_stability, {{levle = 1}})))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("12\ttrue") && Contains("did you mean 'level'?"));
}
