// Films and charts of several runs, by scripts.

#include <filesystem>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <catch2/catch.hpp>

#include "render/frames.hpp"
#include "tests/cli/csv_rows.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;

namespace {

// Runs a script with runs of a bar of 16 nodes: `soft` over 0.5 s, `hard` over 0.3 s at another
// frame rate, `ends` without frames between the first and the last; and `compared`, a comparison.
Ran film(const std::string& call, const TemporaryFolder& scratch) {
  const std::string script = R"lua(
    local s = require "springlod"
    local folder = ...
    local function bar(young)
      return s.lattice(s.grid{cell = 0.1, size = {4, 2, 2}, materials = {bar = {young = young}},
                              fill = function() return "bar" end})
    end
    local function scene(duration)
      return {name = "fall", duration = duration, throw = {position = {0, 0, 0.5}},
              obstacles = {{name = "floor", plane = {0, 0, 1, 0}}}}
    end
    local soft = s.run(bar(1e4), scene(0.5), {quiet = true})
    local hard = s.run(bar(1e6), scene(0.3), {quiet = true, frame_rate = 25, ledger = false})
    local ends = s.run(bar(1e4), scene(0.5), {quiet = true, frame_rate = 0})
    local chain = s.simplify(bar(1e5), {levels = 1})
    local compared = s.compare(chain, scene(0.1))
  )lua";
  const std::filesystem::path file = scratch / "film.lua";
  spit(file, script + call);
  return springlod_run({"-q", "--unsafe", "run", file.string(), "--", scratch.path().string()});
}

}  // namespace

TEST_CASE("several runs are drawn in one film and on one chart") {
  const TemporaryFolder scratch;
  const Ran ran = film(R"lua(
    local labels = {"soft", "hard"}
    print(s.animate(folder .. "/film", {soft, hard},
      {labels = labels, width = 120, height = 90, frame_rate = 10}))
    print(s.animate(folder .. "/three", soft, {width = 120, height = 90, frames = 3}))
    print((s.animate(folder .. "/one", soft, {width = 120, height = 90, frames = 1})))
    s.animate(folder .. "/rows", {soft, hard, soft},
      {columns = 2, width = 120, height = 90, frames = 1, springs = true, camera = "follow"})
    s.chart(folder .. "/height.svg", {soft, hard}, {labels = labels})
    s.chart(folder .. "/kinetic.svg", soft, {quantity = "kinetic", title = "own title"})
    s.chart(folder .. "/levels.svg", {s.run(chain[1], scene(0.2)), s.run(chain[0], scene(0.2))})
    local last = soft.final
    local sum, mass = 0, 0
    for i, node in ipairs(bar(1e4):nodes()) do
      sum, mass = sum + node.mass * last.x[i][3], mass + node.mass
    end
    print(("%.6g"):format(sum / mass))
  )lua",
                       scratch);
  CAPTURE(ran.out, ran.err);
  REQUIRE(ran.exit_code == 0);
  std::istringstream printed(ran.out);
  int frames = 0;
  double rate = 0;
  int frames_of_three = 0;
  double rate_of_three = 0;
  int frames_of_one = 0;
  double final_height = 0;
  printed >> frames >> rate >> frames_of_three >> rate_of_three >> frames_of_one >> final_height;
  CHECK(frames == 6);  // 0.5 s, the longer run
  CHECK(rate == 10);
  CHECK(frames_of_three == 3);
  CHECK(rate_of_three == Approx(2 / 0.5));
  CHECK(frames_of_one == 1);
  const auto size = [&](const std::string& folder) {
    const auto picture = springlod::render::load_png(scratch / (folder + "/frame_0000.png"));
    return std::pair(picture.width, picture.height);
  };
  CHECK(size("film") == std::pair(240U, 90U));
  CHECK(size("one") == std::pair(120U, 90U));
  CHECK(size("rows") == std::pair(240U, 180U));

  const std::vector<Row> heights = rows_of(slurp(scratch / "height.csv"));
  std::vector<Row> soft;
  std::vector<Row> hard;
  for (const Row& row : heights) (row.at("series") == "soft" ? soft : hard).push_back(row);
  REQUIRE(soft.size() == 31);  // 60 frames per second
  REQUIRE(hard.size() == 9);   // 25 frames per second, and the last
  CHECK(std::stod(soft.back().at("x")) == Approx(0.5));
  CHECK(std::stod(hard.back().at("x")) == Approx(0.3));
  CHECK(std::stod(soft.front().at("y")) == Approx(0.5));
  CHECK(std::stod(soft.back().at("y")) == Approx(final_height).epsilon(1e-4));
  const std::string script = slurp(scratch / "height.gp");
  CHECK_THAT(script, Contains("'fall'") && Contains("'time [s]'") &&
                         Contains("'height of the centre of mass [m]'") &&
                         Contains("title 'soft'") && Contains("title 'hard'"));
  CHECK_THAT(slurp(scratch / "kinetic.gp"), Contains("'own title'") &&
                                                Contains("'kinetic energy [J]'") &&
                                                Contains("title 'run 1'"));
  CHECK_THAT(slurp(scratch / "levels.gp"), Contains("title 'level 1'") && Contains("title 'base'"));
}

TEST_CASE("films and charts of runs that do not fit are refused with what to do") {
  const TemporaryFolder scratch;
  const auto refuses = [&](const std::string& call, const std::string& message) {
    const Ran ran = film(call, scratch);
    CAPTURE(call, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(message));
  };
  refuses("s.animate(folder .. '/f', {})", "a list of either (this one is empty)");
  refuses("s.animate(folder .. '/f', {soft, hard}, {labels = {'soft'}})",
          "labels must be a list with one label for each run: 1 labels for 2 runs");
  refuses("s.chart(folder .. '/c.svg', soft, {labels = {'a', 'b'}})", "2 labels for 1 run");
  refuses("s.chart(folder .. '/c.svg', soft, {labels = {'a\\nb'}})", "texts of one line each");
  refuses("s.animate(folder .. '/f', {soft, compared})", "(entry 2 is a Comparison)");
  refuses("s.animate(folder .. '/f', {compared, soft})", "(entry 2 is a Trajectory)");
  refuses("s.chart(folder .. '/c.svg', {soft, 5})", "(entry 2 is a number)");
  refuses("s.animate(folder .. '/f', {soft, ends})",
          "\"run 2\" kept only its first and its last frame; run it with a frame_rate");
  refuses("s.chart(folder .. '/c.svg', {soft, ends})", "\"run 2\" has 2 frames");
  refuses("s.chart(folder .. '/c.svg', {soft, hard}, {quantity = 'elastic'})",
          "\"run 2\" kept no energies");
  refuses("s.chart(folder .. '/c.svg', soft, {quantity = 'hight'})", "did you mean");
  refuses("s.animate(folder .. '/f', soft, {levels = {0}})", "given for comparisons only");
  refuses("s.animate(folder .. '/f', compared, {labels = {'a', 'b'}})", "variant of compare");
  refuses("s.chart(folder .. '/c.svg', compared, {quantity = 'height'})",
          "given for Trajectories only");
}
