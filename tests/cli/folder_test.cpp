// Folders that one run has for itself, and runs that continue in them.

#include <filesystem>

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;
namespace fs = std::filesystem;

namespace {

Ran run_lua(const TemporaryFolder& scratch, const std::string& code) {
  return springlod_run({"-e", "local s = require 'springlod'\nlocal out = arg[1]\n" + code,
                        (scratch / "out").string()});
}

}  // namespace

TEST_CASE("in_folder returns what its function returns, and marks the folder as finished") {
  const TemporaryFolder scratch;
  const std::string code = R"(
    print(s.in_folder(out, function()
      s.save_text(out .. "/a", "x")
      return "first", nil, 3
    end, {command = "bars"})))";
  for (int run = 0; run < 2; ++run) {
    const Ran ran = run_lua(scratch, code);
    CHECK(ran.out == "first\tnil\t3\n");
    CHECK(ran.err.empty());
  }
  CHECK(slurp(scratch / "out/a") == "x");
}

TEST_CASE("in_folder refuses a folder in use or of another command") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    s.in_folder(out, function()
      s.save_text(out .. "/a", "x")
      print(pcall(s.in_folder, out, function() error("not called") end))
    end)
    print(pcall(s.in_folder, out, function() error("not called") end, {command = "bars"}))
    print(pcall(s.in_folder, out, "no function"))
    print(pcall(s.in_folder, out .. "/a", function() end)))");
  CAPTURE(ran.out, ran.err);
  CHECK_THAT(ran.out, Contains("is in use by springlod script (process "));
  CHECK_THAT(ran.out, Contains("holds the results of springlod script"));
  CHECK_THAT(ran.out, Contains("expected a function") && Contains("cannot make the folder"));
  CHECK_THAT(ran.out, !Contains("not called"));
}

TEST_CASE("a function that fails leaves its folder unfinished, or none if it wrote nothing") {
  const TemporaryFolder scratch;
  const Ran ran = run_lua(scratch, R"(
    print(pcall(s.in_folder, out, function() error("too early", 0) end))
    print(s.is_folder(out))
    print(pcall(s.in_folder, out, function()
      s.save_text(out .. "/a", "x")
      error("half done", 0)
    end))
    s.in_folder(out, function() end)
    s.in_folder(out, function() end))");
  CHECK(ran.out == "false\ttoo early\nfalse\nfalse\thalf done\n");
  const std::string said = "the last run of springlod script did not finish";
  CHECK_THAT(ran.err, Contains(said));
  CHECK(ran.err.find(said) == ran.err.rfind(said));
}

TEST_CASE("two commands do not mix their files in one folder") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.5"});
  spit(scratch / "drop.lua", "return {duration = 0.01}");
  const std::string asset = (scratch / "bar.glb").string(), out = (scratch / "out").string();
  const std::vector<std::string> compare{
      "compare",  asset, "--scenario", (scratch / "drop.lua").string(),
      "--frames", "0",   "--out",      out};
  REQUIRE(springlod_run(compare).exit_code == 0);
  const std::string table = slurp(scratch / "out/table.csv");
  const Ran other = springlod_run({"stability", asset, "--quick", "--out", out});
  CHECK(other.exit_code == 1);
  CHECK_THAT(other.err, Contains("the folder " + out + " holds the results of springlod compare"));
  CHECK_FALSE(fs::exists(scratch / "out/map.csv"));
  const Ran again = springlod_run(compare);
  CHECK(again.exit_code == 0);
  CHECK_THAT(again.err, !Contains("did not finish"));
  CHECK(slurp(scratch / "out/table.csv") == table);
}

TEST_CASE("an interrupted study continues after its last unit") {
  const TemporaryFolder scratch;
  const auto refinement = [&](const char* out) {
    return std::vector<std::string>{"refinement", "--quick", (scratch / out).string()};
  };
  const Ran whole = springlod_run(refinement("whole"));
  REQUIRE(whole.exit_code == 0);
  const Ran stopped = springlod_interrupted(refinement("parts"), "corners, 2 cells across");
  CAPTURE(stopped.err);
  CHECK(stopped.exit_code == 130);
  CHECK_THAT(stopped.err, Contains("run the same command again to continue"));
  CHECK(fs::exists(scratch / "parts/unfinished"));
  CHECK_FALSE(fs::exists(scratch / "parts/table.csv"));
  const Ran more = springlod_run(refinement("parts"));
  CAPTURE(more.err);
  CHECK(more.exit_code == 0);
  CHECK_THAT(more.err, Contains("continuing an unfinished run of springlod refinement"));
  CHECK(more.out == whole.out);
  for (const char* table : {"table.csv", "orders.csv"})
    CHECK(slurp(scratch / "parts" / table) == slurp(scratch / "whole" / table));
  CHECK_FALSE(fs::exists(scratch / "parts/unfinished"));
}

TEST_CASE("a stopped series of throws writes the same bytes in the end") {
  const TemporaryFolder scratch;
  // Throw 4 is not fitted, and small.
  const auto throws = [&](const char* out, const char* count) {
    return springlod_run(
        {"throws", "--quick", "--first", "4", "--count", count, "-o", (scratch / out).string()});
  };
  REQUIRE(throws("whole", "2").exit_code == 0);
  // A folder that cannot take the table stops the command after its last throw.
  fs::create_directories(scratch / "parts/throws.csv");
  const Ran stopped = throws("parts", "2");
  CHECK(stopped.exit_code == 1);
  CHECK_THAT(stopped.err, Contains("throws.csv: it is a folder"));
  fs::remove(scratch / "parts/throws.csv");
  CHECK(throws("parts", "2").exit_code == 0);
  CHECK(slurp(scratch / "parts/throws.csv") == slurp(scratch / "whole/throws.csv"));
  CHECK(slurp(scratch / "parts/summary.md") == slurp(scratch / "whole/summary.md"));
}

TEST_CASE("kept units have the values that were computed, to the last bit") {
  const Ran ran = run_lua(TemporaryFolder(), R"(
    local store = require("lib.unit_store").open(out, {n = 1})
    local value = {0.1, 1 / 3, -0.0, math.huge, -5, "a\n\"b\"\0", {x = {true, false}}, [7.5] = 2^60}
    local calls = 0
    local function kept(name)
      return store:value(name, function() calls = calls + 1 return value end)
    end
    local first, again = kept("a"), kept("a")
    assert(calls == 1)
    for i = 1, 6 do
      assert(again[i] == value[i] and math.type(again[i]) == math.type(value[i]), i)
    end
    assert(1 / again[3] == -math.huge)
    assert(again[7].x[1] == true and again[7].x[2] == false and again[7.5] == 2^60)
    kept("b")
    require("lib.unit_store").open(out, {n = 2}):value("a", function() calls = calls + 1 end)
    assert(calls == 3)
    s.save_text(out .. "/unfinished/mine.lua", "of the user")
    store:remove()
    assert(#s.files(out .. "/unfinished") == 1))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
}
