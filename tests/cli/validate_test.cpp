// springlod validate.

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

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

namespace {

/// The rows of a problem's quantity at one level, by size.
std::map<int, Row> by_size(const std::vector<Row>& table, const std::string& problem,
                           const std::string& quantity, const std::string& level) {
  std::map<int, Row> found;
  for (const Row& row : table)
    if (row.at("problem") == problem && row.at("quantity") == quantity && row.at("level") == level)
      found[std::stoi(row.at("size"))] = row;
  return found;
}

/// Error of the base at a size [%].
double error_at(const std::vector<Row>& table, const std::string& problem,
                const std::string& quantity, int size) {
  return number(by_size(table, problem, quantity, "0").at(size), "error");
}

}  // namespace

TEST_CASE("validate --quick: the base converges to known answers with order 2", "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "validate", "--quick", "-o", out.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const auto table = rows_of(slurp(out / "table.csv"));

  // An exact solution on an exact body: order 2 from the start.
  const auto cube = by_size(table, "cube", "omega a / c_t", "0");
  REQUIRE(cube.size() == 2);
  CHECK(number(cube.at(8), "reference") == Approx(4.44288).epsilon(1e-6));
  CHECK(std::abs(number(cube.at(8), "error")) < 1);
  CHECK(number(cube.at(8), "order") == Approx(2).margin(0.25));

  for (const char* kind : {"0T2", "0S2", "0S1"}) {
    CAPTURE(kind);
    CHECK(std::abs(error_at(table, "sphere", kind, 8)) <
          std::abs(error_at(table, "sphere", kind, 6)));
    CHECK(std::abs(error_at(table, "sphere", kind, 8)) < 12);
  }
  // Cells that the surface cuts are more accurate than whole ones.
  for (const char* kind : {"0T2", "0S2", "0S1"}) {
    CAPTURE(kind);
    const double error = std::abs(error_at(table, "sphere_cut", kind, 8));
    CHECK(error < std::abs(error_at(table, "sphere_cut", kind, 6)));
    CHECK(error < std::abs(error_at(table, "sphere", kind, 8)));
  }
  CHECK(std::abs(error_at(table, "hertz", "weight / force at this depth", 8)) < 8);
  CHECK(std::abs(error_at(table, "bounce", "contact time / reference", 8)) < 16);
  CHECK(std::abs(error_at(table, "bounce", "speed after / before", 8)) < 1.5);
  for (const char* quantity : {"tip [m/N]", "f1 [Hz]", "f2 [Hz]", "f3 [Hz]"})
    for (const auto& [problem, most] : {std::pair("cantilever_0", 12), std::pair("cantilever", 6),
                                        std::pair("cantilever_45", 6)}) {
      CAPTURE(quantity, problem);
      const auto rows = by_size(table, problem, quantity, "0");
      CHECK(std::abs(number(rows.at(4), "error")) < most);
      CHECK(number(rows.at(4), "order") > 1.4);
    }
  // The end correction leaves an error of third order.
  for (const char* problem :
       {"cantilever_0_corrected", "cantilever_25_corrected", "cantilever_45_corrected"}) {
    CAPTURE(problem);
    const auto rows = by_size(table, problem, "f1 [Hz]", "0");
    CHECK(std::abs(number(rows.at(4), "error")) < 1.5);
    CHECK(number(rows.at(4), "order") > 2.5);
  }
  for (const char* quantity : {"error of E", "error of nu", "error of E, two materials"})
    CHECK(error_at(table, "stretch", quantity, 4) < 1e-3);
  for (const char* quantity : {"error of E, random", "error of nu, random"})
    CHECK(error_at(table, "stretch", quantity, 4) < 0.02);
  for (const char* problem : {"two_materials", "two_materials_45"}) {
    CAPTURE(problem);
    CHECK(error_at(table, problem, "error of f1 to f10", 4) < 0.06);
    CHECK(error_at(table, problem, "error of nine loads", 4) < 0.17);
    CHECK(error_at(table, problem, "error of nine loads", 4) <
          error_at(table, problem, "error of nine loads", 2) / 2);
  }
  CHECK(std::abs(error_at(table, "silicone", "period, small [s]", 3)) < 6);
  CHECK(std::abs(error_at(table, "silicone", "decay, released [1/s]", 3)) < 12);
  const auto wave = by_size(table, "rayleigh", "c / c_t", "0");
  CHECK(std::abs(number(wave.at(12), "error")) < 1);
  CHECK(number(wave.at(12), "order") == Approx(2).margin(0.5));
  CHECK(std::abs(error_at(table, "sliding", "deceleration / g", 3)) < 1);
  for (const char* level : {"0", "1", "2"})
    for (const char* quantity : {"change of momentum", "change of angular momentum"}) {
      CAPTURE(level, quantity);
      CHECK(number(by_size(table, "spin", quantity, level).at(3), "error") < 1e-12);
    }
  // Small sizes are not judged.
  for (const Row& row : table) CHECK(row.at("within").empty());
  CHECK_THAT(slurp(out / "validation.md"),
             Contains("## Vibrations of a sphere") && Contains("images/validation-cube.png"));
  CHECK(std::filesystem::file_size(out / "images/validation-cube.png") > 0);
}

TEST_CASE(
    "a finite ball has Hertz's force at small depths, and a larger one at 3 % of its radius") {
  const Ran ran = springlod_run({"-e", R"(
    local ball = require "studies.validate.finite_ball"
    local function factor(depth) return ball.force(depth) / ball.hertz_force(depth) end
    print(("%.3f %.3f"):format(factor(1e-8), factor(0.03)))
    local depth, force = ball.at_angle(0.2)
    print(math.abs(ball.force(depth) / force - 1) < 2e-4)
    print(math.abs(ball.depth(force) / depth - 1) < 2e-4)
    local function time(speed) return ball.contact_time(speed) / ball.hertz_contact_time(speed) end
    print(("%.3f %.3f"):format(time(1e-9), time(0.007))))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "1.000 1.189\ntrue\ntrue\n1.000 0.937\n");
}

TEST_CASE(
    "validate solves the problems that are asked for, and names the others if one is unknown") {
  const TemporaryFolder out;
  const std::string folder = out.path().string();
  const Ran ran =
      springlod_run({"-q", "validate", "--problems", "spin,cube", "--quick", "-o", folder});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  std::map<std::string, int> problems;
  for (const Row& row : rows_of(slurp(out / "table.csv"))) ++problems[row.at("problem")];
  CHECK(problems.size() == 2);
  CHECK(problems["spin"] == 2 * 3 * 2);
  const Ran unknown = springlod_run({"validate", "--problems", "sphre", "-o", folder});
  CHECK(unknown.exit_code == 2);
  CHECK_THAT(unknown.err, Contains("'sphre' must be one of all, stretch, cube, sphere"));
}
