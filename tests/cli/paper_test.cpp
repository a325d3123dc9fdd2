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
using springlod::test::springlod_interrupted;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

std::vector<std::string> paper(const std::filesystem::path& folder, const std::string& starts,
                               const std::string& threads) {
  return {
      "paper",        "--out",     folder.string(), "--starts",          starts, "--speeds", "30",
      "--no-figures", "--threads", threads,         "--simplifications", "1"};
}

}  // namespace

TEST_CASE("paper resumes after an interruption, with the same tables for any number of threads",
          "[long]") {
  const TemporaryFolder scratch;
  const Ran whole = springlod_run(paper(scratch / "whole", "5", "2"));
  REQUIRE(whole.exit_code == 0);
  for (const char* part : {"Table 1", "LOD-hb-2", "Table 2", "base at half the step", "die"})
    CHECK_THAT(whole.out, Contains(part));

  const Ran stopped = springlod_interrupted(paper(scratch / "parts", "5", "1"), "rods-30/base");
  CHECK(stopped.exit_code == 130);
  CHECK(std::filesystem::exists(scratch / "parts/runs/rods-30/base.csv"));
  CHECK_FALSE(std::filesystem::exists(scratch / "parts/table-1.csv"));
  const Ran resumed = springlod_run(paper(scratch / "parts", "5", "1"));
  REQUIRE(resumed.exit_code == 0);
  CHECK(resumed.err.find("ball/base") == std::string::npos);
  for (const char* file : {"tables.md", "table-1.csv", "table-2.csv", "early-errors.csv",
                           "three-runs.csv", "energy.csv", "sensitivity.csv"})
    CHECK(slurp(scratch / "parts" / file) == slurp(scratch / "whole" / file));
  CHECK_THAT(slurp(scratch / "parts/index.html"),
             Contains("Table 1: how far the ball rolls") && Contains(">mean over spread<") &&
                 !Contains("mean_over_spread") && Contains("models in the order of the table") &&
                 !Contains("A quick run"));

  std::vector<std::string> with_fitted = paper(scratch / "whole", "5", "2");
  with_fitted.emplace_back("--calibrated");
  const Ran more = springlod_interrupted(with_fitted, "ball/LOD-fit-b-1-seed-1");
  CHECK(more.err.find("ball/LOD-1") == std::string::npos);  // stored runs are not repeated
  CHECK(std::filesystem::exists(scratch / "whole/runs/ball/LOD-fit-b-1-seed-1.csv"));

  std::vector<std::string> one_way = paper(scratch / "whole", "5", "2");
  one_way.insert(one_way.end(), {"--variants", "LOD-b"});
  const Ran fewer = springlod_run(one_way);
  CHECK(fewer.exit_code == 0);
  CHECK(fewer.err.find("ball/LOD") == std::string::npos);
  const std::string table = slurp(scratch / "whole/table-1.csv");
  CHECK(std::count(table.begin(), table.end(), '\n') == 4);  // columns, base, two levels
  CHECK_THAT(table, Contains("LOD-b-2"));
  one_way.back() = "LOD-x";
  CHECK(springlod_run(one_way).exit_code == 2);

  const Ran mixed = springlod_run(paper(scratch / "whole", "6", "2"));
  CHECK(mixed.exit_code == 1);
  CHECK_THAT(mixed.err, Contains("holds runs with starts = 5, not 6; use another folder"));
}

TEST_CASE("paper --volumes: the soft ball has corners, and none is inverted at the end") {
  const TemporaryFolder scratch;
  std::vector<std::string> arguments = paper(scratch / "out", "5", "1");
  arguments.emplace_back("--volumes");
  const Ran stopped = springlod_interrupted(arguments, "ball/base");
  CHECK(stopped.exit_code == 130);
  const std::vector<Row> rows = rows_of(slurp(scratch / "out/runs/ball/base.csv"));
  CHECK(rows.size() == 5);
  for (const Row& row : rows) CHECK(row.at("inverted_at_end") == "0");

  const Ran without = springlod_run(paper(scratch / "out", "5", "1"));
  CHECK(without.exit_code == 1);
  CHECK_THAT(without.err, Contains("holds runs with volumes = true, not false"));
}

TEST_CASE("paper identifies the materials of kept runs by content, independent of the path") {
  const TemporaryFolder scratch;
  const auto with_materials = [&](const std::string& file, const std::string& shell) {
    // Soft, so that the time step is long. The name of the unused material has all characters that
    // CSV quotes.
    const std::string core = "core = {young = '10 kPa', density = 1000, colour = {0.5, 0.2, 0.2}}";
    const std::string spare = R"(['spare, "100 %"\n'] = {young = 1e6, density = 1000})";
    spit(scratch / file,
         "return {" + core + ", " + spare + ", shell = {young = '" + shell + "', density = 200}}");
    std::vector<std::string> arguments = paper(scratch / "out", "5", "1");
    arguments.insert(arguments.end(), {"--ball-materials", (scratch / file).string()});
    return arguments;
  };
  const Ran wrong = springlod_run(with_materials("ball.lua", "5 kg"));
  CHECK(wrong.exit_code == 1);
  CHECK_FALSE(std::filesystem::exists(scratch / "out/runs"));

  const Ran stopped = springlod_interrupted(with_materials("ball.lua", "5 kPa"), "ball/base");
  CHECK(stopped.exit_code == 130);
  const Ran changed = springlod_run(with_materials("ball.lua", "6 kPa"));
  CHECK(changed.exit_code == 1);
  CHECK_THAT(changed.err, Contains("holds runs with ball_materials = {core = {") &&
                              Contains("young = 5 kPa") && Contains("young = 6 kPa") &&
                              Contains("use another folder"));
  const Ran moved = springlod_interrupted(with_materials("moved.lua", "5 kPa"), "other-starts");
  CHECK(moved.exit_code == 130);
  CHECK(moved.err.find("ball/base") == std::string::npos);
}
