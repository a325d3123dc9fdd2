// springlod poisson_ways.

#include <cmath>
#include <cstddef>
#include <map>
#include <string>

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

TEST_CASE("poisson_ways --quick: ways are exact in a stretch, and differ in bending and step") {
  const TemporaryFolder out;
  const std::string path = (out / "ways.csv").string();
  const Ran ran = springlod_run({"-q", "poisson_ways", "--quick", "--out", path});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("| node terms |") && Contains("| 0.45 |"));
  const std::string before = "The program's own models differ from cell terms by ";
  const std::size_t at = ran.out.find(before);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(ran.out.substr(at + before.size())) < 1e-8);  // tips

  const auto rows = rows_of(slurp(path));
  REQUIRE(rows.size() == 3 * 2);
  std::map<std::string, double> tip, step;
  for (const Row& row : rows) {
    const std::string name = row.at("way") + " " + row.at("nu");
    CAPTURE(name);
    CHECK(std::abs(number(row, "E error")) < 1e-9);
    CHECK(std::abs(number(row, "nu error")) < 1e-9);
    CHECK(number(row, "zero modes") == 6);
    tip[name] = number(row, "tip error, 2 cells");
    step[name] = number(row, "step");
  }
  // Springs alone.
  CHECK(std::abs(tip["node terms 0.25"] - tip["cell terms 0.25"]) < 1e-9);
  CHECK(step["cell terms 0.25"] == 1);
  // Cube diagonals and node terms are stiffer in bending; node terms take longer steps.
  CHECK(tip["cube diagonals 0.25"] < tip["cell terms 0.25"]);
  CHECK(tip["cube diagonals 0.45"] < tip["cell terms 0.45"]);
  CHECK(tip["node terms 0.45"] < tip["cell terms 0.45"]);
  CHECK(step["node terms 0.45"] > step["cell terms 0.45"]);
  CHECK(step["cell terms 0.45"] < 0.6);
}

TEST_CASE("poisson_ways: zero modes and the equilibrium of simple energies are right") {
  const Ran ran = springlod_run({"-e", R"(
    local energies = require "studies.poisson_ways.energies"
    local spring = energies.energy(1, {{1, {-1, 0, 0}}, {2, {1, 0, 0}}})
    print(energies.zero_modes({spring}, 6))
    local u = energies.equilibrium({energies.energy(4, {{1, {2, 0, 0}}})}, 3, {8},
      {[2] = true, [3] = true})
    print(u[1], u[2], u[3]))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "5\n0.5\t0.0\t0.0\n");
}
