// Wrong arguments of the API and of the commands: ranges of options, lengths of messages.

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

/// What the script prints; it must not fail.
std::string printed(const std::string& script) {
  const Ran ran = springlod_run({"-q", "-e", "local s = require 'springlod'\n" + script});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  return ran.out;
}

}  // namespace

TEST_CASE("Calls with wrong arguments return or are refused") {
  const TemporaryFolder scratch;
  const auto script = springlod::test::source_folder() / "tests/mutations/calls.lua";
  const Ran ran = springlod_run({"-q", "run", script.string(), "--", "400"}, "", scratch.path());
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  // The table: functions, a method, and the sum.
  for (const char* row : {"voxelize", "simplify", "Trajectory:frame", "all"})
    CHECK_THAT(ran.out, Contains(row));
}

TEST_CASE("Numbers, texts and lists beyond the range of an option are refused") {
  const std::string out = printed(R"(
    local function refusal(call, ...)
      local ok, failure = pcall(call, ...)
      assert(not ok and failure.kind == "input", tostring(failure))
      print(failure.message)
    end
    local base = s.model{nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}},
                         springs = {{1, 2, k = 100}}}
    local chain = s.simplify(base, {levels = 0})
    refusal(s.run, base, {duration = 1}, {frame_rate = 1e9})
    refusal(s.run, base, {duration = 1e5}, {frame_rate = 1e5})
    refusal(s.run, base, {duration = 1e9})
    refusal(s.run, base, {duration = 1}, {step = "1e-16 s"})
    refusal(s.certify, chain, {held_out_loads = 1e9})
    refusal(s.chart, "a.svg", {{points = {{1, 1}}}}, {title = ("t"):rep(100000)})
    refusal(s.simplify, base, {keep = {0.5, 7}})
    local endings = {}
    for i = 1, 100001 do endings[i] = ".obj" end
    refusal(s.files, ".", {endings = endings})
    refusal(s.json, {}, {indent = 1000000000})
    local bushy = {}
    for _ = 1, 50 do bushy = {bushy, bushy} end
    refusal(s.json, bushy)
    local box = s.grid{cell = 1, size = {2, 2, 2}, materials = {a = {}},
                       fill = function() return "a" end}
    refusal(s.refill, s.lattice(box), box, {nodes = 2^31})
    refusal(s.refill, s.lattice(box), box, {nodes = {1000}})
    refusal(s.scenario, {gravity = {0, 0, 1e300}})
    refusal(s.grid, {cell = 1, size = {4096, 4096, 4096}, materials = {a = {}}, fill = print}))");
  CHECK_THAT(out, Contains("run: frame_rate must be from 0 to 1000000, got 1e+09"));
  CHECK_THAT(out, Contains("makes 1e+10 frames in 100000 s") && Contains("use at most"));
  CHECK_THAT(out, Contains("scenario: duration must be from 0.001 us to 1e+05 s, got 1e+09 s"));
  CHECK_THAT(out, Contains("run: step must be from 1e-09 us to 100 s"));
  CHECK_THAT(out, Contains("held_out_loads must be a whole number of 0 to 10000"));
  CHECK_THAT(out, Contains("chart: title must be text of at most 1000 bytes, got 100000"));
  CHECK_THAT(out, Contains("simplify: keep must be from 0 to 1, got 7"));
  CHECK_THAT(out, Contains("endings must be a list of at most 100000 entries, got 100001"));
  CHECK_THAT(out, Contains("indent must be a whole number of -1 to 16"));
  CHECK_THAT(out, Contains("json: more than 2000000 values"));
  CHECK_THAT(out, Contains("refill: nodes must be a whole number of 1 to 2000000, got 2147483648"));
  CHECK_THAT(out, Contains("refill: nodes must be at most 27, the number of the base's nodes"));
  CHECK_THAT(out, Contains("gravity[3] must be from -1e+15 m/s2"));
  CHECK_THAT(out, Contains("size must be three counts of cells, together at most 10000000"));
}

TEST_CASE("Help, options_of and the reference name the ranges") {
  const std::string out = printed(R"(
    help("run")
    help("chart")
    for _, option in ipairs(s.options_of("certify")) do
      if option.name == "held_out_loads" then print(option.least, option.most) end
      if option.name == "seed" then print("seed", option.least) end
    end)");
  CHECK_THAT(out, Contains("quantity in s, 1e-09 us to 100 s; default safety"));
  CHECK_THAT(out, Contains("integer, 1 to 10000; default 20 for backward Euler"));
  CHECK_THAT(out, Contains("string, at most 1000 bytes; default the scenario's name"));
  CHECK_THAT(out, Contains("0.0\t10000.0") && Contains("seed\tnil"));
}

TEST_CASE("Flags of commands have ranges") {
  const auto refusal = [](const std::vector<std::string>& arguments) {
    const Ran ran = springlod_run(arguments);
    CHECK(ran.exit_code == 2);
    return ran.err;
  };
  CHECK_THAT(refusal({"compare", "a.glb", "--starts", "10000000"}),
             Contains("--starts: '10000000' must be an integer of 1 to 1000000"));
  CHECK_THAT(refusal({"compare", "a.glb", "--slow", "1e300"}),
             Contains("--slow: '1e300' must be a number above 0, up to 1e+15"));
  CHECK_THAT(refusal({"convert", "a.obj", "-o", "a.glb", "--levels", "100000"}),
             Contains("--levels: '100000' must be an integer of 0 to 1000"));
}

TEST_CASE("Messages cut long words of the user and escape control characters") {
  const std::string out = printed(R"(
    local function message(call, ...)
      local ok, failure = pcall(call, ...)
      assert(not ok and failure.kind ~= "internal")
      return failure.message
    end
    print(#message(s.import, ("x"):rep(100000)) < 1000)
    print(#message(s.options_of, ("k"):rep(1000000)) < 1000)
    print(#message(s.simplify, ("k"):rep(1000000)) < 1000)
    print(#message(s.scenario, {[("k"):rep(1000000)] = 1}) < 2100)
    print(#message(s.quantity, ("5 "):rep(50000), "length") < 2100)
    print(message(s.options_of, "\27[31mred")))");
  CHECK(out.find("false") == std::string::npos);
  CHECK_THAT(out, Contains("\\x1b[31mred"));
}
