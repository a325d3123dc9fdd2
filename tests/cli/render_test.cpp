// Options of s.render in scripts.

#include <catch2/catch.hpp>

#include "render/frames.hpp"
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
