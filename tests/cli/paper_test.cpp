// `springlod paper` with few runs.

#include <algorithm>

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::Row;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

using Words = std::vector<std::string>;

Words joined(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Arguments of short studies.
Words few_runs(const Words& variants, const std::string& starts = "5") {
  return joined({"--starts", starts, "--speeds", "30", "--no-figures", "--simplifications", "1",
                 "--variants"},
                variants);
}

Words paper(const std::filesystem::path& folder, const Words& arguments,
            const std::string& threads = "2") {
  return joined({"paper", "--out", folder.string(), "--threads", threads}, arguments);
}

}  // namespace

TEST_CASE("paper goes on where a sweep of it ended, with the same tables for any number of threads",
          "[long]") {
  const TemporaryFolder scratch;
  const Words arguments = few_runs({"LOD-b", "LOD-hb"});
  const Ran whole = springlod_run(paper(scratch / "whole", arguments));
  CAPTURE(whole.err);
  REQUIRE(whole.exit_code == 0);
  for (const char* part : {"Table 1", "LOD-hb-2", "Table 2", "base at half the step", "die"})
    CHECK_THAT(whole.out, Contains(part));

  const std::string parts = (scratch / "parts").string();
  const Ran planned =
      springlod_run(joined({"sweep", "plan", "paper", "--out", parts, "--"}, arguments));
  CAPTURE(planned.err);
  REQUIRE(planned.exit_code == 0);
  REQUIRE(springlod_run({"sweep", "run", parts, "--task", "0"}).exit_code == 0);
  const std::filesystem::path first = scratch / "parts/results/0000/0000000.json";
  const std::string before = slurp(first);  // with the time that it took
  REQUIRE_FALSE(before.empty());
  CHECK_FALSE(std::filesystem::exists(scratch / "parts/table-1.csv"));
  const Ran resumed = springlod_run(paper(parts, arguments, "1"));
  CAPTURE(resumed.err);
  REQUIRE(resumed.exit_code == 0);
  CHECK(slurp(first) == before);
  for (const char* file :
       {"tables.md", "table-1.csv", "table-2.csv", "early-errors.csv", "three-runs.csv",
        "energy.csv", "sensitivity.csv", "index.html", "results-throws.csv"}) {
    CAPTURE(file);
    CHECK(slurp(scratch / "parts" / file) == slurp(scratch / "whole" / file));
  }
  CHECK_THAT(slurp(scratch / "parts/index.html"),
             Contains("Table 1: how far the ball rolls") && Contains(">mean over spread<") &&
                 !Contains("mean_over_spread") && Contains("models in the order of the table") &&
                 !Contains("A quick run"));

  const std::string table = slurp(scratch / "whole/table-1.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 6);  // columns, base, two levels of each
  CHECK_THAT(table, Contains("LOD-b-2") && Contains("LOD-hb-1"));

  const Ran mixed = springlod_run(paper(parts, few_runs({"LOD-b", "LOD-hb"}, "6")));
  CHECK(mixed.exit_code == 1);
  CHECK_THAT(mixed.err, Contains("holds results of the arguments --starts 5") &&
                            Contains("choose another folder"));
  CHECK(springlod_run(paper(scratch / "unknown", few_runs({"LOD-x"}))).exit_code == 2);
}

TEST_CASE("paper --volumes: the soft ball has corners, and none is inverted at the end", "[long]") {
  const TemporaryFolder scratch;
  const std::string folder = (scratch / "out").string();
  const auto must = [](const Words& words) {
    const Ran ran = springlod_run(words);
    CAPTURE(words, ran.err);
    REQUIRE(ran.exit_code == 0);
  };
  must(joined({"sweep", "plan", "paper", "--out", folder, "--", "--volumes"}, few_runs({"LOD-b"})));
  for (const char* task : {"0", "1"}) must({"sweep", "run", folder, "--task", task});  // throws
  must({"sweep", "merge", folder});
  int starts = 0;
  for (const Row& row : rows_of(slurp(scratch / "out/results-throws.csv"))) {
    if (row.at("name") != "ball/base") continue;
    ++starts;
    CHECK(row.at("inverted_at_end") == "0");
  }
  CHECK(starts == 5);
}

TEST_CASE("paper refuses a folder with runs of other materials") {
  const TemporaryFolder scratch;
  const auto plan = [&](const std::string& shell) {
    // The name of the unused material has all characters that CSV quotes.
    const std::string core = "core = {young = '10 kPa', density = 1000, colour = {0.5, 0.2, 0.2}}";
    const std::string spare = R"(['spare, "100 %"\n'] = {young = 1e6, density = 1000})";
    spit(scratch / "ball.lua",
         "return {" + core + ", " + spare + ", shell = {young = '" + shell + "', density = 200}}");
    return springlod_run({"sweep", "plan", "paper", "--out", (scratch / "out").string(), "--",
                          "--starts", "5", "--ball-materials", (scratch / "ball.lua").string()});
  };
  CHECK(plan("5 kg").exit_code != 0);
  CHECK_FALSE(std::filesystem::exists(scratch / "out/plan.json"));
  REQUIRE(plan("5 kPa").exit_code == 0);
  REQUIRE(springlod_run({"sweep", "run", (scratch / "out").string(), "--task", "0"}).exit_code ==
          0);
  const Ran changed = plan("6 kPa");
  CHECK(changed.exit_code == 1);
  CHECK_THAT(changed.err, Contains("holds results of another content of") && Contains("ball.lua") &&
                              Contains("choose another folder"));
  CHECK(plan("5 kPa").exit_code == 0);
}
