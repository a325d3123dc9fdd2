// springlod throws.

#include <set>

#include <catch2/catch.hpp>

#include "tests/cli/csv_rows.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;

namespace {

std::vector<Row> rows_in(const TemporaryFolder& folder) {
  return rows_of(slurp(folder / "throws.csv"));
}

/// The lines of one throw in a throws.csv.
std::string lines_of(const std::string& table, const std::string& throw_number) {
  std::istringstream lines(table);
  std::string found;
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(throw_number + ",")) found += line + "\n";
  return found;
}

}  // namespace

TEST_CASE("throws --quick: bodies keep their shape, and two runs write the same bytes", "[long]") {
  const TemporaryFolder once, again;
  const Ran ran = springlod_run({"throws", "--quick", "-o", once.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.err, Contains("12/12 throw 12"));
  CHECK_THAT(ran.out, Contains("inverted at"));

  const std::vector<Row> rows = rows_in(once);
  CHECK(rows.size() == 36);  // 12 throws, three levels
  std::set<std::string> bases, precisions;
  for (const Row& row : rows) {
    CAPTURE(row.at("throw"), row.at("level"), row.at("message"));
    REQUIRE(row.at("error").empty());
    CHECK(number(row, "inverted_at_end") == 0);
    CHECK(number(row, "inverted_at_end") <= number(row, "most_inverted"));
    CHECK((number(row, "most_inverted") > 0) == !row.at("first_inversion").empty());
    CHECK(number(row, "ledger_error") < 0.05);
    CHECK((number(row, "scheme_error") > 0) == (row.at("integrator") != "symplectic_euler"));
    if (number(row, "corners") > 0) {  // small levels may have none
      CHECK(number(row, "volume_ratio") > 0.5);
      CHECK(number(row, "volume_ratio") < 1.5);
    }
    bases.insert(row.at("base"));
    precisions.insert(row.at("precision"));
  }
  CHECK(bases == std::set<std::string>{"centers", "corners", "random"});
  CHECK(precisions.size() == 2);
  CHECK_THAT(slurp(once / "summary.md"), Contains("| all | 36 | 0 | 0 |"));
  CHECK_THAT(slurp(once / "chart.svg"), Contains("wave speed"));

  REQUIRE(springlod_run({"throws", "--quick", "-q", "-o", again.path().string()}).exit_code == 0);
  for (const char* file : {"throws.csv", "summary.md"})
    CHECK(slurp(once / file) == slurp(again / file));
}

TEST_CASE("throws: without volumes, the soft ball of throw 11 stays inverted") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"throws", "--quick", "-q", "--no-volumes", "--first", "11",
                                 "--count", "1", "-o", out.path().string()});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK(number(rows_in(out).at(0), "inverted_at_end") > 0);
  CHECK_THAT(ran.out, Contains("springlod throws --seed 1 --quick --no-volumes --only N"));
}

TEST_CASE("a throw depends on the seed and its number alone") {
  const TemporaryFolder pair, single, other;
  const auto thrown = [](const TemporaryFolder& out, const char* first, const char* count,
                         const char* seed) {
    REQUIRE(springlod_run({"throws", "--quick", "-q", "--first", first, "--count", count, "--seed",
                           seed, "-o", out.path().string()})
                .exit_code == 0);
    return lines_of(slurp(out / "throws.csv"), "4");
  };
  const std::string second = thrown(pair, "3", "2", "1");
  CHECK_FALSE(second.empty());
  CHECK(second == thrown(single, "4", "1", "1"));
  CHECK(second != thrown(other, "4", "1", "2"));

  const Ran only = springlod_run({"throws", "--quick", "--only", "4"}, "", single.path());
  CHECK(only.exit_code == 0);
  CHECK_THAT(only.out, Contains("level 2") && Contains("ledger gap"));
  CHECK_FALSE(std::filesystem::exists(single / "out"));
}
