// springlod picks.

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::number;
using springlod::test::Ran;
using springlod::test::Row;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("springlod picks compares predicted picks with runs", "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "picks", out.path().string(), "--quick"});
  CAPTURE(ran.err, ran.out);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("best by runs") && Contains("6 picks: "));
  const auto levels = rows_of(slurp(out / "levels.csv"));
  REQUIRE(levels.size() == 2 * 4);  // scenes times levels
  for (const Row& row : levels) {
    CAPTURE(row.at("scene"), row.at("level"));
    if (row.at("level") == "0")
      CHECK(number(row, "measured") == 0);
    else
      CHECK(number(row, "predicted") < 5 * number(row, "measured"));
    CHECK(number(row, "measured") < 5 * number(row, "predicted") + 1e-12);
  }
  const auto picks = rows_of(slurp(out / "picks.csv"));
  REQUIRE(picks.size() == 2 * 3);  // scenes times tolerances
  for (const Row& row : picks) CHECK(number(row, "predicted") <= number(row, "tolerance"));
}

TEST_CASE("springlod picks refuses bodies that its set does not have") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"picks", out.path().string(), "--bodies", "cube"});
  CHECK(ran.exit_code == 1);
  CHECK_THAT(ran.err, Contains("--bodies: no body of the set checking"));
}
