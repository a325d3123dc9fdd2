// Damping of materials as a ratio or a time, and what runs report about their step.

#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

/// Runs the script after defining `bar`: a lattice of 4 x 4 x 8 cells of one material.
Ran with_bar(const std::string& script, const std::string& argument = "") {
  return springlod_run({"-e", R"(
    local s = require "springlod"
    local function bar(material, cell)
      return s.lattice(s.grid{cell = cell or "10 cm", size = {4, 4, 8},
        materials = {bar = material}, fill = function() return "bar" end})
    end
    local still = {gravity = {0, 0, 0}, duration = 0.5}
  )" + script,
                        argument});
}

}  // namespace

TEST_CASE("a body has the same step in its own periods in millimetres and in metres") {
  const Ran ran = springlod_run({"-e", R"(
    local s = require "springlod"
    local shares = {}
    for i, unit in ipairs{"mm", "m"} do
      local mesh = s.import("samples/dumbbell.obj", {unit = unit})
      local extent = mesh.max[1] - mesh.min[1]
      local model = s.lattice(s.voxelize(mesh, {cell = extent / 23}))
      local undamped = s.model{nodes = model:nodes(), springs = (function()
        local springs = model:springs()
        for _, spring in ipairs(springs) do spring.c = 0 end
        return springs
      end)()}
      shares[i] = s.stable_step(model) / s.stable_step(undamped)
      print(("%.6g"):format(model.materials[1].damping / extent))
    end
    assert(math.abs(shares[1] / shares[2] - 1) < 1e-9)
    assert(shares[1] > 0.5 and shares[1] < 1)
  )"});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  const auto line_end = ran.out.find('\n');
  CHECK(ran.out == ran.out.substr(0, line_end + 1) + ran.out.substr(0, line_end + 1));
}

TEST_CASE("a material has its damping as a time after the model is built") {
  const Ran ran = with_bar(R"(
    local usual, twice = bar({young = "1 MPa"}), bar({young = "1 MPa", damping_ratio = 0.02})
    print(twice.materials[1].damping / usual.materials[1].damping)
    print(usual.materials[1].damping_ratio)
    print(bar({damping = "3 ms"}).materials[1].damping)
    print(bar({damping_ratio = 0}).materials[1].damping)
    print(bar({damping = "3 ms"}))
    local spring = twice:spring(1)
    print(math.abs(spring.c / spring.k / twice.materials[1].damping - 1) < 1e-12)
  )");
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("2.0\nnil\n0.003\n0.0\n") && Contains("damping time 3 ms\ntrue\n"));
}

TEST_CASE("a model from tables has the ratio too, from its springs and masses") {
  const Ran ran = with_bar(R"(
    local nodes, springs = {}, {}
    for i = 0, 10 do nodes[i + 1] = {i / 10, 0, 0, mass = 0.1} end
    for i = 1, 10 do springs[i] = {i, i + 1, k = 1000} end
    local chain = s.model{nodes = nodes, springs = springs,
                          materials = {{name = "m", damping_ratio = 0.05}}}
    -- c = sqrt(sum k L^2 / (6 M)) = sqrt(100 / 6.6), the extent is 1 m
    local omega = math.pi * math.sqrt(100 / 6.6)
    local beta = chain.materials[1].damping
    print(math.abs(beta * omega / 2 / 0.05 - 1) < 1e-12,
          math.abs(chain:spring(1).c - 1000 * beta) < 1e-12)
    print(s.model{nodes = {{0, 0, 0, mass = 1}}}.materials[1].damping)
  )");
  CAPTURE(ran.err);
  CHECK(ran.out == "true\ttrue\n0.0\n");
}

TEST_CASE("damping as a time and as a ratio, or a ratio out of range, is an error") {
  const auto refused = [](const std::string& material) {
    return with_bar("bar(" + material + ")").err;
  };
  CHECK_THAT(refused("{damping = '1 ms', damping_ratio = 0.1}"),
             Contains("materials.bar: damping and damping_ratio are both given"));
  CHECK_THAT(refused("{damping_ratio = 1/0}"), Contains("damping_ratio must be finite"));
  CHECK_THAT(refused("{damping_ratio = -0.1}"),
             Contains("materials.bar: damping_ratio must be from 0 to 1, got -0.1"));
  CHECK_THAT(refused("{damping_ratio = 1}"),
             Contains("material \"bar\": damping_ratio = ") && Contains("below 1"));
}

TEST_CASE("a run names what limits its step, and hints at damping") {
  const Ran ran = with_bar(R"(
    local function limited(material, options)
      local run = s.run(bar(material), still, options)
      print(run.limited_by, run.undamped_step >= run.predicted_step)
    end
    limited{}
    limited({damping = "0.1 s"}, {quiet = true})
    limited({damping = "0.1 s"}, {step = "0.01 ms"})
    print(s.choices.limited_by.damping.help ~= nil)
  )");
  CAPTURE(ran.out, ran.err);
  CHECK(ran.out == "springs\ttrue\ndamping\ttrue\nasked\ttrue\ntrue\n");
  // Not that it is empty: a run of many steps on a slow machine also reports its progress.
  CHECK_THAT(ran.err, !Contains("damping shortens"));
  const Ran hint = with_bar("s.run(bar{damping = '0.1 s'}, still)");
  CHECK_THAT(hint.err, Contains("run: damping shortens the step to") &&
                           Contains("% of that without damping") && Contains("damping_ratio"));
}

TEST_CASE("the hint at damping is printed once for each body") {
  const springlod::test::TemporaryFolder scratch;
  const auto hints = [](const Ran& ran) {
    std::size_t count = 0;
    for (auto at = ran.err.find("damping shortens"); at != std::string::npos;
         at = ran.err.find("damping shortens", at + 1))
      ++count;
    return count;
  };
  const Ran same = with_bar(R"(
    local chain = s.simplify(bar{damping = "0.1 s"}, {levels = 1})
    s.save(arg[1], chain)
    for level = 0, 1 do s.run(chain[level], still) end
    s.compare(chain, still)
    for i = 1, 2 do s.run(s.load(arg[1])[0], still) end)",
                            (scratch / "bar.glb").string());
  CAPTURE(same.err);
  CHECK(same.exit_code == 0);
  CHECK(hints(same) == 1);
  CHECK(hints(with_bar("for _, time in ipairs{0.1, 0.2} do s.run(bar{damping = time}, still) "
                       "end")) == 2);
}

TEST_CASE("a comparison and an asset name what limits the steps of their levels") {
  const springlod::test::TemporaryFolder scratch;
  const Ran ran = with_bar(R"(
    local chain = s.simplify(bar{damping = "0.1 s"}, {levels = 1})
    for _, row in ipairs(s.compare(chain, still):table()) do
      print(row.limited_by, row.undamped_step > 2 * row.step)
    end
    for _, level in ipairs(s.info(chain).levels) do
      print(level.limited_by, level.undamped_dt > 2 * level.stable_dt)
    end
    s.save(arg[1], chain))",
                           (scratch / "bar.glb").string());
  CAPTURE(ran.err);
  CHECK(ran.out == "damping\ttrue\ndamping\ttrue\ndamping\ttrue\ndamping\ttrue\n");
  CHECK_THAT(ran.err, Contains("compare: damping shortens the steps of 2 of 2 levels"));
  const Ran info = springlod_run({"info", (scratch / "bar.glb").string()});
  CHECK_THAT(info.out, Contains("without") && Contains("damping") && Contains("limited") &&
                           Contains("damping") && Contains("damping time 100 ms"));
}
