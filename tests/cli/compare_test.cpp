#include <algorithm>
#include <map>

#include <catch2/catch.hpp>

#include "render/frames.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace fs = std::filesystem;

namespace {

const char* const kScenario =
    "return {name = 'drop', duration = 0.2, throw = {velocity = {1, 0, 0}},\n"
    "        obstacles = {{plane = {0, 0, 1, -0.05}, name = 'floor', friction = 0.4}}}\n";

void make_asset(const TemporaryFolder& scratch) {
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.25", "--lattice", "centers"});
  spit(scratch / "drop.lua", kScenario);
}

std::vector<std::string> compare_arguments(const TemporaryFolder& scratch, const std::string& out) {
  return {"compare",    (scratch / "bar.glb").string(),
          "--scenario", (scratch / "drop.lua").string(),
          "--out",      (scratch / out).string(),
          "--starts",   "2",
          "--frames",   "3",
          "--width",    "160",
          "--height",   "120",
          "--variant",  "x"};
}

// The content of every file below a folder, by relative path.
std::map<std::string, std::string> contents(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = slurp(entry.path());
  return files;
}

// A text without what is between two marks.
std::string without(std::string text, const std::string& from, const std::string& to) {
  const std::size_t start = text.find(from);
  REQUIRE(start != std::string::npos);
  return text.erase(start, text.find(to, start) - start);
}

}  // namespace

TEST_CASE("compare writes table, chart, frames and timings, with identical results in every run") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran ran = springlod_run(compare_arguments(scratch, "one"));
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("x level 1") && Contains("x level 2"));

  auto one = contents(scratch / "one");
  for (const char* name : {"table.csv", "starts.csv", "timings.csv", "frames/frame_0000.png"})
    CHECK(one.count(name) == 1);
  CHECK_THAT(one["table.csv"], StartsWith("level,label,nodes,springs,ends,step,"));
  CHECK(std::count(one["table.csv"].begin(), one["table.csv"].end(), '\n') == 4);
  CHECK(std::count(one["timings.csv"].begin(), one["timings.csv"].end(), '\n') == 1 + 3 * 2);
  CHECK(one["table.csv"].find("wall") == std::string::npos);
  CHECK(springlod::render::load_png(scratch / "one/frames/frame_0000.png").width == 3 * 160);
  // gnuplot draws the chart and ffmpeg the video; without them the commands are printed.
  CHECK((one.count("chart.svg") == 1 || ran.err.find("gnuplot") != std::string::npos));
  CHECK((one.count("chart.png") == 1 || ran.err.find("gnuplot") != std::string::npos));
  CHECK((one.count("comparison.mp4") == 1 || ran.err.find("ffmpeg") != std::string::npos));

  std::vector<std::string> arguments = compare_arguments(scratch, "two");
  arguments.insert(arguments.begin(), {"--threads", "1"});
  REQUIRE(springlod_run(arguments).exit_code == 0);
  auto two = contents(scratch / "two");
  for (const char* name : {"timings.csv", ".springlod-run"}) {  // times, number of the process
    one.erase(name);
    two.erase(name);
  }
  // The page states the command, which differs.
  CHECK_THAT(one["index.html"], Contains("--out " + (scratch / "one").string()));
  one["index.html"] = without(one["index.html"], "<pre id=\"command\">", "</pre>");
  two["index.html"] = without(two["index.html"], "<pre id=\"command\">", "</pre>");
  REQUIRE(one.size() == two.size());
  for (const auto& [name, bytes] : one) {
    CAPTURE(name);
    CHECK(two[name] == bytes);
  }
}

TEST_CASE("compare takes several assets into one table, chart and film") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  make_bar_asset(scratch / "other.glb", 1, {"--cell", "0.25", "--lattice", "centers"});
  std::vector<std::string> arguments = compare_arguments(scratch, "both");
  arguments.insert(arguments.begin() + 2, (scratch / "other.glb").string());
  const Ran ran = springlod_run(arguments);
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  for (const char* label : {"x-bar base", "x-bar level 1", "x-other base", "x-other level 1"})
    CHECK_THAT(ran.out, Contains(label));
  CHECK_THAT(ran.out, Contains("Means over 2 starts. cost ratio: "));
  auto files = contents(scratch / "both");
  const std::string& table = files["table.csv"];
  const auto rows = std::count(table.begin(), table.end(), '\n') - 1;
  CHECK(rows >= 5);
  // A panel for each row except the second base.
  CHECK(springlod::render::load_png(scratch / "both/frames/frame_0000.png").width ==
        160 * (rows - 1));
}

TEST_CASE("compare reports errors of asset and scenario in one line") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const auto refused = [&](const std::string& scenario, const std::string& reason) {
    spit(scratch / "drop.lua", scenario);
    const Ran ran = springlod_run(compare_arguments(scratch, "out"));
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains("springlod: cannot compare"));
    CHECK_THAT(ran.err, Contains(reason));
    CHECK_THAT(ran.err, !Contains("traceback"));
  };
  refused("return {duratoin = 1}", "did you mean 'duration'?");
  refused("return {obstacles = {{plane = {0, 0, 1}}}}", "obstacles[1].plane");
  refused("return {obstacles = {{plane = {0, 0, 1, 0}, fiction = 1}}}", "did you mean 'friction'?");
  refused("return {measure_from = 'wall'}", "wall");
  refused("return 3", "must return a table, got a number");
  refused("x = 1", "must return a table, got nothing");
  refused("return {", "drop.lua");
}

TEST_CASE("compare warns of a body that starts inside an obstacle") {
  const TemporaryFolder scratch;
  make_asset(scratch);
  const Ran above = springlod_run(compare_arguments(scratch, "above"));
  CHECK_THAT(above.err, !Contains("inside"));
  // The bar reaches from 0 to 1 m above the plane 0.05 m below it; here it is 0.5 m higher.
  spit(scratch / "drop.lua",
       "return {name = 'drop', duration = 0.01,\n"
       "        obstacles = {{plane = {0, 0, 1, 0.5}, name = 'floor'}}}\n");
  const Ran inside = springlod_run(compare_arguments(scratch, "inside"));
  CHECK_THAT(inside.err, Contains("the body starts") &&
                             Contains("deep inside the obstacle floor") &&
                             Contains("change throw.position"));
}

TEST_CASE("a diverging simulation fails with node and time") {
  const TemporaryFolder scratch;
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    local m = s.model{nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}},
                      springs = {{1, 2, k = 1e4, length = 1.2}}}
    local ok, failure = pcall(s.run, m, {duration = 10, gravity = {0, 0, 0}}, {step = 0.1})
    print(ok, failure.kind, math.type(failure.node), failure.node <= 2, failure.time > 0))"});
  CAPTURE(ran.err);
  CHECK(ran.out == "false\tunstable\tinteger\ttrue\ttrue\n");
}

TEST_CASE("compare shows rounding errors as 0 and names its page by the file of the scene") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.5", "--lattice", "centers"});
  spit(scratch / "space.lua", "return {duration = 0.02, gravity = {0, 0, 0}}");
  const Ran ran = springlod_run({"compare", (scratch / "bar.glb").string(), "--scenario",
                                 (scratch / "space.lua").string(), "--out",
                                 (scratch / "out").string(), "--starts", "2", "--frames", "0"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains(" 0 m ") && !Contains(" nm") && !Contains("e-"));
  CHECK_THAT(slurp(scratch / "out/index.html"), Contains("<title>bar: space</title>"));
}
