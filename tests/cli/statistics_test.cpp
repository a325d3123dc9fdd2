// Statistics in scripts: passing samples. tests/report checks the numbers.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

Ran run_lua(const std::string& code) {
  return springlod_run({"-q", "-e",
                        "local s = require 'springlod'\n"
                        "local base = {1, 2, 3, 4, 5, 6, 7, 8}\n"
                        "local other = {1.1, 2.2, 3.1, 4, 5, 6.2, 7, 8.2}\n" +
                            code});
}

}  // namespace

TEST_CASE("statistics of one sample, two samples and a noise floor in a script") {
  const Ran ran = run_lua(R"(
    local m = s.statistics(base)
    print(m.count, m.mean, m.median, m.minimum, m.maximum, m.lower_quartile)
    print(m.mean_low < 4.5 and 4.5 < m.mean_high, m.deviation_low < m.deviation)
    local c = s.compare_samples(base, other, {paired = true, margin = 0.5})
    print(string.format("%.3f %.3f", c.difference.value, c.wasserstein.value), c.equivalent, c.p)
    print(c.difference.low <= 0.1 and 0.1 <= c.difference.high, c.p == math.max(c.p_lower, c.p_higher))
    print(s.compare_samples(base, other).equivalent, s.compare_samples(base, other, {margin = 0.5}).equivalent)
    local floor = s.noise_floor(base, {size = 8})
    print(floor)
    print(floor:judge(base, other).inside, floor:judge(base, {21, 22, 23, 24, 25, 26, 27, 28}).inside)
    print(#floor.distances, floor.with_replacement, s.noise_floor(base).size))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("8\t4.5\t4.5\t1.0\t8.0\t2.75\n"
                               "true\ttrue\n"
                               "0.100 0.100\ttrue\t"));
  CHECK_THAT(ran.out, Contains("true\ttrue\nnil\tfalse\nNoiseFloor: wasserstein distance "));
  CHECK_THAT(ran.out, Contains("95 % of 2000 distances, 8 against 8 values, drawn with "
                               "replacement)\ntrue\tfalse\n2000\ttrue\t4\n"));
}

TEST_CASE("the mean of a list takes any number of values but none") {
  const Ran ran = run_lua(R"(
    print(s.mean(base), s.mean{0.1, 0.2, 0.3} == (0.1 + 0.2 + 0.3) / 3, s.mean{7})
    print(pcall(s.mean, {}))
    print(pcall(s.mean, {1, "x"})))");
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("4.5\ttrue\t7.0\n") && Contains("has 0 values") &&
                          Contains("sample[2] must be a number"));
}

TEST_CASE("statistics are identical for the same seed") {
  const char* code =
      "print(s.inspect(s.compare_samples(base, other, {margin = 0.5, seed = 3})),"
      "s.noise_floor({base, other}, {size = 5, seed = 3}).level)";
  const Ran one = run_lua(code);
  CHECK(one.exit_code == 0);
  CHECK(one.out == run_lua(code).out);
}

TEST_CASE("several seeds are passed as one list per start, and their design matters") {
  const Ran ran = run_lua(R"(
    local by_start = {}
    for i, x in ipairs(base) do by_start[i] = {x - 0.5, x + 0.5, x} end
    local crossed = s.compare_samples(base, by_start, {paired = true, margin = 1})
    local nested = s.compare_samples(base, by_start, {paired = true, margin = 1, seeds = "nested"})
    print(crossed.difference.value, nested.difference.high - nested.difference.low)
    print(crossed.difference.high > 0.2, crossed.p > nested.p))");
  CAPTURE(ran.err);
  CHECK(ran.out == "0.0\t0.0\ntrue\ttrue\n");
}

TEST_CASE("invalid samples are refused with their position") {
  const Ran ran = run_lua(R"(
    print(pcall(s.compare_samples, base, {1, 2, "x"}))
    print(pcall(s.compare_samples, base, {{1, 2}, {3}}))
    print(pcall(s.compare_samples, base, {{1, 2}, 3}))
    print(pcall(s.compare_samples, base))
    print(pcall(s.statistics, {1, 2, 0 / 0, 4, 5}))
    print(pcall(s.statistics, {}))
    print(pcall(s.compare_samples, base, {1, 2, 3, 4, 5}, {paired = true}))
    print(pcall(s.noise_floor, {base, other})))");
  CAPTURE(ran.err);
  for (const char* message :
       {"other[3] must be a number, not a string",
        "other[2] and other[1] differ in length, 1 and 2", "other[2] must be a list as other[1] is",
        "bad argument 2 (other) of compare_samples", "value 3 of the sample",
        "has 0 values, but at least 5", "cannot be paired", "2 sources form 1 pairs"})
    CHECK_THAT(ran.out, Contains(message));
}
