// springlod precision.

#include <cmath>

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using springlod::test::number;
using springlod::test::Ran;
using springlod::test::Row;
using springlod::test::rows_of;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

TEST_CASE("precision --quick: single precision agrees with double within bounds", "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "precision", out.path().string(), "--quick"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);

  const auto frequencies = rows_of(slurp(out / "frequencies.csv"));
  REQUIRE(frequencies.size() == 3 * 10);
  for (const Row& row : frequencies) {
    CAPTURE(row.at("body"), row.at("mode"));
    CHECK(std::abs(number(row, "single / double - 1")) < 1e-5);
    CHECK(number(row, "standard error") < 1e-7);
    // The leapfrog frequency, up to the geometric nonlinearity of the springs.
    CHECK(std::abs(number(row, "double / stepped - 1")) < 1e-4);
    CHECK(number(row, "stepped [Hz]") > number(row, "modal [Hz]"));
  }

  for (const Row& row : rows_of(slurp(out / "amplitudes.csv"))) {
    CAPTURE(row.at("body"), row.at("amplitude / size"));
    // The geometric nonlinearity is quadratic in the amplitude.
    const double amplitude = number(row, "amplitude / size");
    CHECK(std::abs(number(row, "double / stepped - 1")) < 1e-9 + 30 * amplitude * amplitude);
    if (amplitude > 3e-5) CHECK(std::abs(number(row, "single / double - 1")) < 3e-4);
  }

  const auto drops = rows_of(slurp(out / "drops.csv"));
  REQUIRE(drops.size() == 3);
  for (const Row& row : drops) {
    CAPTURE(row.at("body"));
    CHECK(number(row, "first contact [s]") < 0.5);
    CHECK(number(row, "largest before contact") < 1e-6);
    CHECK(number(row, "rms at 1 s") > 0);
    CHECK(number(row, "rms at 1 s") < 0.1 * number(row, "rms at 1 s of half the step"));
    CHECK(number(row, "ledger double") < 1e-3);
    CHECK(number(row, "ledger single") < 1e-3);
  }

  // Damping dissipates the motion that rounding errors cause.
  for (const Row& row : rows_of(slurp(out / "rest.csv"))) {
    CAPTURE(row.at("body"), row.at("damping [s]"));
    CHECK(number(row, "moved in 1 s") < (number(row, "damping [s]") > 0 ? 1e-6 : 1e-4));
  }
  CHECK(slurp(out / "chart.svg").find("rods: half the step") != std::string::npos);
}
