// springlod gains.

#include <cmath>
#include <string>
#include <vector>

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

namespace {

const std::vector<std::string> kGains = {
    "plain", "certificate", "clock_nodes", "clock_surface", "clock_flight", "clock_same_kernel",
};

}  // namespace

TEST_CASE("springlod gains measures gains by the clock beside those by certificate") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "gains", out.path().string(), "--quick"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("clock over") && Contains("geometric means"));
  const auto rows = rows_of(slurp(out / "gains.csv"));
  REQUIRE(rows.size() == 2);  // levels
  for (const Row& row : rows) {
    CAPTURE(row.at("level"));
    for (const std::string& gain : kGains) {
      CAPTURE(gain);
      CHECK(std::isfinite(number(row, gain)));
      CHECK(number(row, gain) > 0);
    }
    CHECK(number(row, "nodes") < number(row, "base_nodes"));
    CHECK(number(row, "low") <= number(row, "clock_surface"));
    CHECK(number(row, "clock_surface") <= number(row, "high"));
    CHECK(number(row, "clock_over_certificate") ==
          Approx(number(row, "clock_surface") / number(row, "certificate")));
    // Both count springs and steps; runs do so after rounding the number of steps.
    CHECK(number(row, "updates") == Approx(number(row, "plain")).epsilon(0.05));
    CHECK(row.at("base_kernel") == "rows");
  }
  CHECK(rows[0].at("kernel") == "quads");
  const auto means = rows_of(slurp(out / "means.csv"));
  REQUIRE(means.size() == 2 * 2);  // one scene and all, times levels
  for (const Row& row : means) {
    const Row& only = rows[row.at("level") == "1" ? 0 : 1];
    for (const std::string& gain : kGains) CHECK(number(row, gain) == Approx(number(only, gain)));
  }
}

TEST_CASE("springlod gains refuses bodies and scenes that it does not have") {
  CHECK_THAT(springlod_run({"gains", "--bodies", "teapot"}).err,
             Contains("--bodies: 'teapot' must be one of"));
  const Ran scene = springlod_run({"gains", "--scenes", "storm"});
  CHECK(scene.exit_code == 2);
  CHECK_THAT(scene.err, Contains("--scenes: 'storm' must be one of"));
}
