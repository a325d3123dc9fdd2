#include "sweep/unit_result.hpp"

#include <cmath>
#include <limits>

#include <catch2/catch.hpp>

#include "base/error.hpp"

namespace springlod::sweep {
namespace {

TEST_CASE("Cells are read as they were written, to the last bit") {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const UnitResult result{.unit = 7,
                          .rows = {{0.1, -0.0, 1e-310, 12.0},
                                   {std::int64_t{12}, true, std::string("a,\"b\n"), {}},
                                   {std::string("\xff\0x", 3), std::string("\u00fc"), true, {}},
                                   {kInfinity, -kInfinity, std::int64_t{-1}, false}},
                          .target = "AVX2",
                          .blas = "Haswell",
                          .host = "node1",
                          .seconds = 0.25,
                          .memory = 1U << 20};
  const UnitResult read = result_from_text(to_text(result));
  CHECK(read.unit == 7);
  CHECK(read.rows == result.rows);
  CHECK(std::signbit(std::get<double>(read.rows[0][1])));
  CHECK(read.target == "AVX2");
  CHECK(read.blas == "Haswell");
  CHECK(read.host == "node1");
  CHECK(read.memory == result.memory);
  CHECK(read.failure.empty());
}

TEST_CASE("What is not a number stays so") {
  const UnitResult result{.rows = {{std::numeric_limits<double>::quiet_NaN()}}};
  CHECK(std::isnan(std::get<double>(result_from_text(to_text(result)).rows.at(0).at(0))));
}

TEST_CASE("A failure keeps its message and signal") {
  const UnitResult read =
      result_from_text(to_text({.unit = 1, .failure = "no \xff luck", .signal = 11}));
  CHECK(read.failure.substr(0, 3) == "no ");
  CHECK(read.signal == 11);
}

TEST_CASE("A damaged result is an error") {
  for (const char* text : {"", "{}", "{\"unit\": 1, \"rows\": [", "[1]", "{\"unit\": \"x\"}"})
    CHECK_THROWS_AS(result_from_text(text), InputError);
}

}  // namespace
}  // namespace springlod::sweep
