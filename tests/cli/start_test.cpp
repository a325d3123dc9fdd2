// Runs from given positions and velocities.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

Ran with_bar(const std::string& script) {
  return springlod_run({"-e", R"(
    local s = require "springlod"
    local bar = s.lattice(s.grid{cell = "10 cm", size = {4, 2, 1}, fill = function() return "bar" end,
      materials = {bar = {young = "1 MPa", density = 1000, damping = 0}}})
    local function far(a, b) -- largest difference of two lists of points
      local most = 0
      for i, p in ipairs(a) do
        for d = 1, 3 do most = math.max(most, math.abs(p[d] - b[i][d])) end
      end
      return most
    end
  )" + script});
}

}  // namespace

TEST_CASE("a run continues from the end of another run") {
  const Ran ran = with_bar(R"(
    local function scene(duration)
      return {duration = duration, throw = {position = {0, 0, 0.2}, spin = {0, 3, 1}},
              obstacles = {{plane = {0, 0, 1, 0}, friction = 0}}}
    end
    local how = {step = "0.1 ms", sleep = 0}
    local whole = s.run(bar, scene(0.4), how)
    local half = s.run(bar, scene(0.2), how)
    assert(whole.first_contact < 0.2, "the floor is part of it")
    how.start = half.final
    local rest = s.run(bar, scene(0.2), how)
    assert(far(rest[1].x, half.final.x) == 0 and rest[1].time == 0)
    -- Without damping and friction what a restart changes is rounding.
    print(far(rest.final.x, whole.final.x) < 1e-9, far(rest.final.v, whole.final.v) < 1e-7)
    print(far(half.final.x, whole.final.x) > 1e-3)
    how.start = {x = half.final.x}
    print(far(s.run(bar, scene(1e-4), how).final.x, half.final.x) < 1e-5)
    how.start = {v = half.final.v}
    print(far(s.run(bar, scene(1e-4), how)[1].x, half.final.x) > 0.1)
    how.start, how.precision = half.final, "single"
    local single = far(s.run(bar, scene(0.2), how).final.x, whole.final.x)
    print(single > 0 and single < 1e-3))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "true\ttrue\ntrue\ntrue\ntrue\ntrue\n");
}

TEST_CASE("a start that does not fit the model is refused with its position") {
  const Ran ran = with_bar(R"(
    local function refused(start)
      local ok, failure = pcall(s.run, bar, {duration = 0.01}, {start = start})
      print(ok, failure)
    end
    local points = {}
    for i = 1, bar.node_count do points[i] = {i, 0, 0} end
    refused{x = {{0, 0, 0}}}
    refused{v = 3}
    points[2] = {1, 2}
    refused{x = points}
    points[2] = {1, 2, 0 / 0}
    refused{v = points}
    points[2] = {1, 2, "5 kg"}
    refused{v = points}
    refused{place = points}
    refused(7))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, !Contains("true"));
  for (const char* message :
       {"run: start.x must be a list of 30 points {x, y, z}, one per node, got 1\n",
        "run: start.v must be a list of 30 points {x, y, z}, one per node, got a number",
        "run: start.x[2] must be a list of three numbers", "run: start.v[2][3] must be finite",
        "run: start.v[2][3]: \"5 kg\"", "unknown option 'place'", "run: start: expected a table"})
    CHECK_THAT(ran.out, Contains(message));
}
