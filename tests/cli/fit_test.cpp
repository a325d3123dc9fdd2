// springlod fit.

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Contains;
using springlod::test::number;
using springlod::test::Ran;
using springlod::test::Row;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("springlod fit measures elasticity, blows and vibration of levels", "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "fit", out.path().string(), "--quick"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("default") && Contains("periods") && Contains("2..5"));
  const auto rows = rows_of(slurp(out / "levels.csv"));
  REQUIRE(rows.size() == 2 * 3);  // levels times variants
  for (const Row& row : rows) {
    CAPTURE(row.at("variant"), row.at("level"));
    const double impulse = number(row, "impulse");
    if (row.at("variant") == "free")
      CHECK(impulse > 1);  // masses moved
    else
      CHECK(impulse < 1e-9);
    CHECK(number(row, "period 1") > 1);
    CHECK(number(row, "period 1") < 100);
    CHECK(number(row, "periods 2..5") > 1);
    CHECK(number(row, "MAC") > 0.5);
    CHECK(number(row, "MAC") <= 1);
    CHECK(number(row, "landing 0..50 ms") > 0);
    CHECK(number(row, "landing 0..50 ms") < number(row, "landing 50..200 ms"));
    CHECK(number(row, "landing 50..200 ms") < 100);
  }
}

TEST_CASE("springlod fit --trade-off charts gain against errors", "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "fit", out.path().string(), "--quick", "--trade-off"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const auto rows = rows_of(slurp(out / "means.csv"));
  REQUIRE(rows.size() == 2 * 6);  // levels times aims
  CHECK(rows.front().at("variant") == "1.30");
  CHECK(rows.back().at("variant") == "0.70");
  for (const Row& row : rows) CHECK(number(row, "gain") > 1);
  CHECK((std::filesystem::exists(out / "trade-off.svg") ||
         ran.err.find("gnuplot") != std::string::npos));
}

TEST_CASE("springlod fit refuses bodies that it does not have") {
  const TemporaryFolder out;
  const Ran both = springlod_run({"fit", out.path().string(), "--trade-off", "--landings-only"});
  CHECK(both.exit_code == 2);
  CHECK_THAT(both.err, Contains("--trade-off has variants of its own and no landings"));
  const Ran unknown = springlod_run({"fit", out.path().string(), "--bodies", "teapot"});
  CHECK(unknown.exit_code == 1);
  CHECK_THAT(unknown.err, Contains("'teapot' must be samples, others, firm or one of"));
}
