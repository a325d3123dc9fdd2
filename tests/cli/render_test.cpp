// Options of s.render in scripts.

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

#include "render/frames.hpp"
#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using namespace springlod::test;

namespace {

// Runs `call`, which may use s, m (a model of two nodes), run (a run of m over 0.1 s) and folder.
Ran draw(const std::string& call, const TemporaryFolder& scratch) {
  const std::string script = R"(
    local s = require "springlod"
    local folder = ...
    local m = s.model{nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 2}}, springs = {{1, 2, k = 100}}}
    local run = s.run(m, {duration = 0.1})
  )";
  return springlod_run({"-q", "-e", script + call, scratch.path().string()});
}

}  // namespace

TEST_CASE("invalid options of render are reported with the valid ones") {
  const TemporaryFolder scratch;
  const auto refuses = [&](const std::string& arguments, const std::string& message) {
    const Ran ran = draw("s.render(folder .. '/a.png', " + arguments + ")", scratch);
    CAPTURE(arguments, ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(message));
  };
  refuses("m, {node_colour = 'youngs'}", "did you mean");
  refuses("m, {node_values = {1, 2, 3}}", "3 numbers for a model of 2 nodes");
  refuses("m, {node_values = {}}", "it is empty");
  refuses("m, {node_values = {1, 'two'}}", "node_values[2]");
  refuses("m, {node_values = {1, 2}, node_colour = 'mass'}", "give one of them");
  refuses("m, {value_range = {2, 1}}", "low < high");
  refuses("m, {value_range = 3}", "{low, high}");
  refuses("m, {node_values = {-1, 2}, value_scale = 'logarithmic'}", "above 0");
  refuses("m, {cut = {0, 0, 0, 1}}", "normal");
  refuses("m, {cut = {1, 0, 0}}", "{nx, ny, nz, offset}");
  refuses("run, {frame = 1, time = 0.05}", "give one of them");
  refuses("run, {time = 3}", "within the run");
  refuses("{{m, tittle = 'a'}}", "unknown option 'tittle'");
  refuses("{{m, m}}", "one subject");
  refuses("{m, title = 'a'}", "{{run, title = ...}}");
  refuses("{{m, cut = 5}}", "panel 1");
  refuses("m, {camera = 'fit'}", "one of fixed, follow");
}

TEST_CASE("panels of one picture can show different things and times, in rows") {
  const TemporaryFolder scratch;
  const Ran ran = draw(R"lua(
    s.render(folder .. "/a.png", {
      {m, node_colour = "mass", title = "mass\nof two nodes"}, {m, node_values = {3, 4}},
      {run, time = "20 ms"}, {run, frame = 1}, m,
    }, {width = 120, height = 90, columns = 2, title = "a title", camera = "fixed",
        value_label = "v (m/s)", cut = {1, 0, 0, -1}, node_size = "mass"})
    s.animate(folder .. "/frames", s.compare(s.simplify(m, {levels = 0}), {duration = 0.1}),
      {frames = 1, width = 80, height = 60, node_colour = "young"})
  )lua",
                       scratch);
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const auto picture = springlod::render::load_png(scratch / "a.png");
  CHECK(picture.width == 240);
  CHECK(picture.height > 270);
}

TEST_CASE("bodies of 2 cm, 1 m and 30 m each fill their panel") {
  const TemporaryFolder scratch;
  const Ran ran = draw(R"lua(
    local subjects = {}
    for i, size in ipairs {0.02, 1, 30} do
      local file = io.open(folder .. "/cube.obj", "w")
      for corner = 0, 7 do
        file:write(("v %g %g %g\n"):format(size * (corner & 1), size * (corner >> 1 & 1),
          size * (corner >> 2 & 1)))
      end
      file:write("f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n")
      file:close()
      subjects[i] = s.import(folder .. "/cube.obj", {unit = "m", up = "z"})
    end
    s.render(folder .. "/a.png", subjects, {width = 160, height = 120})
  )lua",
                       scratch);
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const auto picture = springlod::render::load_png(scratch / "a.png");
  for (int left = 0; left < 480; left += 160) {
    int low_x = 160, high_x = -1, low_y = 120, high_y = -1;
    for (int y = 0; y < 120; ++y)
      for (int x = 2; x < 158; ++x) {  // between the dividers
        const std::uint8_t* p = &picture.rgb[3 * static_cast<std::size_t>(y * 480 + left + x)];
        const auto [least, most] = std::minmax({p[0], p[1], p[2]});
        if (most - least < 60) continue;  // the backdrop is grey
        low_x = std::min(low_x, x);
        high_x = std::max(high_x, x);
        low_y = std::min(low_y, y);
        high_y = std::max(high_y, y);
      }
    CAPTURE(left, low_x, high_x, low_y, high_y);
    CHECK(high_y - low_y > 90);
    CHECK(low_y > 1);
    CHECK(high_y < 118);
    CHECK(low_x > 3);
    CHECK(high_x < 156);
    CHECK(std::abs(low_x + high_x - 160) < 12);
  }
}

TEST_CASE("the command render draws levels and meshes") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.25", "--fast"});
  const std::string asset = (scratch / "bar.glb").string();
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "-q", "render", "-o", (scratch / "a.png").string(), "--width", "120", "--height", "90"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Ran ran = springlod_run(arguments);
    CAPTURE(ran.err);
    REQUIRE(ran.exit_code == 0);
    return springlod::render::load_png(scratch / "a.png");
  };
  const auto all = render({asset});
  CHECK(all.width == 3 * 120);
  CHECK(all.height == 90);
  const auto coarsest = render({asset, "--level", "2"});
  CHECK(coarsest.width == 120);
  CHECK(coarsest.rgb != render({asset, "--level", "0"}).rgb);
  CHECK(render({asset, "--level", "0", "--cut", "y"}).rgb !=
        render({asset, "--level", "0", "--cut", "x"}).rgb);
  const std::string mesh = (source_folder() / "samples/dumbbell.obj").string();
  CHECK(render({mesh}).width == 120);
  CHECK(render({mesh, "--cut", "y"}).rgb != render({mesh}).rgb);
  CHECK(render({asset, mesh, "--columns", "2"}).height == 180);

  const Ran none = springlod_run({"render", asset, "--level", "7", "-o", "x.png"});
  CHECK(none.exit_code == 1);
  CHECK_THAT(none.err, Contains("--level 7: the asset has the levels 0 to 2"));
}
