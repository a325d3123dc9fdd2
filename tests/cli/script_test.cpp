#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using Catch::Matchers::StartsWith;
using springlod::test::obj_of_boxes;
using springlod::test::Ran;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

Ran run_lua(const std::string& code, const std::vector<std::string>& arguments = {}) {
  std::vector<std::string> all{"-q", "-e", "local s = require 'springlod'\n" + code};
  all.insert(all.end(), arguments.begin(), arguments.end());
  return springlod_run(all);
}

}  // namespace

TEST_CASE("errors of one node and of missing materials read as sentences") {
  const auto refused = [](const std::string& code, const std::string& reason) {
    const Ran ran = springlod_run({"-e", "local s = require 'springlod' " + code});
    CAPTURE(ran.err);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(reason));
  };
  refused("s.simplify(s.model{nodes = {{0, 0, 0, mass = 1}}}, {levels = 1})",
          "level 0 is the coarsest possible one, because it has 1 node");
  refused("s.grid{cell = 1, size = {1, 1, 1}}",
          "materials must be given, as in materials = {a = {young = \"1 MPa\"}}");
  refused("s.grid{cell = 1, size = {1, 1, 1}, materials = 3}",
          "a table of materials by name, as in {rod = {young = \"1 MPa\"}}, got a number");
}

TEST_CASE("the script of the architecture page runs, and so does every function of the API") {
  const TemporaryFolder scratch;
  spit(scratch / "dumbbell.obj",
       obj_of_boxes({{"rod", 0, 9}, {"rubber", 9, 14}, {"rod_2", 14, 23}}, 4));
  const Ran ran = run_lua(R"(
    local folder = ...
    local called = {}
    for name, value in pairs(s) do
      if type(value) == "function" then
        s[name] = function(...)
          called[name] = true
          return value(...)
        end
      end
    end
    local mesh = s.import(folder .. "/dumbbell.obj", {unit = "cm", up = "z"})
    print(mesh)
    local grid = s.voxelize(mesh, {cell = "1 cm", materials = {
      rod    = {young = "10 MPa", density = 1000, damping = 0.004, colour = "#336699"},
      rubber = {young = "0.2 MPa", density = 1000, damping = 0.004, colour = {1, 0.5, 0}},
      paint  = {young = "1 MPa"}},
      priority = {"rod", "rubber"},
      core = {depth = "1.6 cm", material = {name = "bone", young = 1e7}},
      paint = function(x, y, z, depth, material)
        if x > 0.22 and depth > 0 and material == "default" then return "paint" end
      end})
    print(grid)
    s.save_vdb(folder .. "/grid.vdb", grid)
    assert(s.load_vdb(folder .. "/grid.vdb").cell_count == grid.cell_count)
    local base  = s.lattice(grid, {style = "centers"})
    print(base)
    local chain = s.simplify(base, {levels = 2, grouping = "priority", border = "weak", seed = 1})
    print(chain)
    s.save(folder .. "/out/dumbbell.glb", chain)
    local scene = s.scenario{gravity = {0, 0, -9.81}, duration = 0.05,
                             throw = {velocity = {3, 0, 0}, spin = {0, "90 deg/s", 0}},
                             obstacles = {{plane = {0, 0, 1, -0.01}, friction = 0.5},
                                          {box = {center = {1, 0, 0}, size = {1, 1, 1},
                                                  turn = {axis = {0, 0, 1}, angle = "45 deg"}}}}}
    print(scene)
    local runs  = s.compare(chain, scene, {starts = 2, jitter = 0.02})
    print(runs)
    s.animate(folder .. "/out/frames", runs, {width = 80, height = 60, frames = 2})
    s.video(folder .. "/out/film.gif", folder .. "/out/frames")
    s.chart(folder .. "/out/cost-error.svg", runs)
    s.chart(folder .. "/out/line.svg",
            {{name = "line", points = {{1, 2, label = "a"}, {2, 3, low = 2.5, high = 3.5}}}},
            {title = "t", log_y = true})
    s.save_text(folder .. "/out/mean.txt", "" .. s.mean{1, 2, 6})
    assert(s.hash{file = folder .. "/out/mean.txt"} == s.hash{text = "3.0"})
    assert(s.base64(folder .. "/out/mean.txt") == "My4w")
    assert(#s.view(runs, {frames = 2}).bodies == 3)
    s.csv(folder .. "/out/rows.csv", {{1, "two"}, {3, "four, five"}}, {columns = {"a", "b"}})
    local trajectory = s.run(chain[1], scene, {frame_rate = 100})
    print(trajectory)
    assert(#s.export(folder .. "/out/level", chain, {to = "jolt", level = 2}).files == 2)
    assert(#s.export_motion(folder .. "/out/fall", trajectory, {to = "glb"}).files == 1)
    s.render(folder .. "/out/still.png", {mesh, base, chain, trajectory},
             {width = 64, height = 48, titles = {"a", "b"}, springs = true})
    local again = s.load(folder .. "/out/dumbbell.glb")
    assert(s.json(s.info(again)) == s.json(s.info(chain)), "an asset reads back as it was")
    assert(s.stretch(base, {axis = "x"}).young > 0)
    assert(s.zero_modes(chain[1])[1].zero_modes == 6)
    assert(s.stable_step(chain[0]) > 0)
    assert(s.estimate(base).young > 0)
    assert(s.grid{cell = 0.1, size = {2, 1, 1}, materials = {bar = {young = 1e6}},
                  fill = function() return "bar" end}.cell_count == 2)
    assert(tostring(s.compare({chain, chain}, {duration = 0.01}, {variants = {"a", "b"}}))
      :find("Comparison of base, a level 1.*Comparison of base, b level 1"))
    assert(#s.bodies(grid) == 1 and grid.body_count == 1)
    assert(#s.ensemble(chain[2], scene, {starts = 2, integrator = "xpbd"}) == 2)
    assert(s.stability(chain, {levels = {2}, ratios = {1}, steps = {1.2},
                               integrators = {"symplectic_euler"}}).verdicts.diverged == 1)
    assert(s.random(grid, {nodes = 120}).node_count == 120)
    assert(s.refill(base, grid, {nodes = 60, style = "random"})[1].node_count == 60)
    assert(s.grid{cell = 1, size = {1, 1, 1}, materials = {a = {young = 1e6}},
                  fill = function() return "a" end}.cell_count == 1)
    assert(#s.ensemble(chain[1], scene, {starts = 2}) == 2)
    local second = s.jittered(scene, base, {number = 2})
    assert(#s.deviation(s.run(chain[1], second), s.run(base, second)) > 1)
    assert(s.options_of("Guard")[2].name == "least_springs")
    assert(s.pick(chain, scene, {error = "90 %", measure = true}).level == 2)
    local modes = s.modes(chain[1], {count = 3, seed = 2})
    assert(#modes == 3 and modes[1].frequency > 0 and #modes[1].shape == chain[1].node_count)
    assert(s.deflect(base, {force = {[1] = {1, 0, 0}}}).compliance > 0)
    local loads = s.static_loads(chain[1])
    assert(#loads == 9 and loads[9].name == "twist x" and loads[9].compliance > 0)
    assert(#loads[1].force == chain[1].node_count and #loads[1].displacement[1] == 3)
    assert(s.quantity("5 mm", "length") == 0.005)
    assert(s.same_file(folder .. "/.", folder) and not s.same_file(folder, folder .. "/no"))
    assert(s.in_folder(folder .. "/claimed", function() return 7 end) == 7)
    assert(s.is_folder(folder) and #s.files(folder, {endings = {".obj"}}) == 1)
    s.model{nodes = {{0, 0, 0, mass = 1}}}
    s.say("quiet")
    assert(s.info(s.certify(chain, {modes = 5})).levels[2].certificate.cost_ratio < 1)
    local step = s.merge_log(chain, {modes = 3, local_loads = 1})[1]
    assert(#step.merges == chain[1].node_count and step.from == 0 and step.frequency_error > 0)
    s.inspect(s.info(chain))
    s.statistics({1, 2, 3, 4, 5})
    s.compare_samples({1, 2, 3, 4, 5}, {2, 3, 4, 5, 6})
    print(s.noise_floor({1, 2, 3, 4, 5}))
    s.format_table({{a = 1.5}})
    s.use_flags{hinges = "--hinges"}
    assert(s.in_flags('give hinges = "fill"') == "give --hinges fill")
    s.help("simplify")
    s.api_markdown()
    local units = "{count = 2, columns = {'n'}, unit = function(p) return {n = p.index} end}"
    s.save_text(folder .. "/units.lua", "return require('springlod').sweep" .. units)
    local sweep = s.sweep(load("return " .. units)())
    assert(s.plan_sweep(sweep, folder .. "/sweep", {script = folder .. "/units.lua"}).units == 2)
    assert(s.run_sweep(folder .. "/sweep", {workers = 1}).done == 2)
    assert(s.sweep_plan(folder .. "/sweep").tasks == 1)
    assert(s.sweep_status(folder .. "/sweep").done == 2)
    assert(s.sweep_results(sweep, folder .. "/sweep").rows[2].n == 2)
    assert(s.forget_failures(folder .. "/sweep") == 0)
    assert(s.submit_sweep(folder .. "/sweep", {dry_run = true}) == "") -- nothing is left
    s.merge_sweep(folder .. "/sweep")
    s.work_on_sweep(sweep, folder .. "/sweep", "logs/none.log") -- nobody asks for units
    s.remove_sweep(folder .. "/sweep")
    assert(not pcall(s.sweep_plan, folder .. "/sweep"))
    assert(#s.join_stability{{level = 0, verdict = "stable"}}:table() == 1)
    for name, value in pairs(s) do
      if type(value) == "function" and not called[name] then print("NEVER CALLED", name) end
    end)",
                          {scratch.path().string()});
  CAPTURE(ran.out, ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.err.empty());
  CHECK_THAT(ran.out, !Contains("NEVER CALLED"));
  CHECK_THAT(ran.out, Contains("Mesh: 16 vertices, 36 triangles, 3 parts, 230 mm x 40 mm x 40 mm"));
  CHECK_THAT(ran.out, Contains("Grid: 368 cells of 10 mm"));
  CHECK_THAT(ran.out,
             Contains("Model: 368 nodes (") && Contains("2374 springs") && !Contains("ends"));
  CHECK_THAT(ran.out, Contains("LodChain: 368 -> ") && Contains("2374 -> ") && !Contains("ends)"));
}

TEST_CASE("a model from tables reads back node by node and spring by spring") {
  const Ran ran = run_lua(R"(
    local m = s.model{
      materials = {{name = "soft", young = 1e5, damping = 0.01}, {name = "hard", young = 1e7}},
      nodes = {{0, 0, 0, mass = "500 g"}, {"10 cm", 0, 0, mass = 2, material = "hard", border = true},
               {x = 0, y = 0.1, z = 0, mass = 1, volume = 0.5, contact_area = 0.01}},
      springs = {{3, 1, k = 50, c = 0.25}, {1, 2, k = 100, length = 0.2}}}
    local a, b = m:spring(1), m:spring(2)
    print(a.a, a.b, a.k, a.c, a.length)
    print(b.a, b.b, b.k, b.c, b.length)
    local n = m:nodes()
    print(#n, n[1].mass, n[1].material, n[2].material, n[2].border, n[2].x, n[3].volume,
          n[3].contact_area)
    print(s.inspect(m.bounds))
    -- What it gives, it takes.
    local again = s.model{materials = m.materials, nodes = m:nodes(), springs = m:springs()}
    print(s.inspect(again:springs()) == s.inspect(m:springs()),
          s.inspect(again:nodes()) == s.inspect(m:nodes())))");
  CAPTURE(ran.err);
  CHECK(ran.out ==
        "1\t2\t100.0\t1.0\t0.2\n"
        "1\t3\t50.0\t0.25\t0.1\n"
        "3\t0.5\tsoft\thard\ttrue\t0.1\t0.5\t0.01\n"
        "{diagonal = 0.14142135623731, high = {0.1, 0.1, 0.0}, low = {0.0, 0.0, 0.0}}\n"
        "true\ttrue\n");
}

TEST_CASE("a model from tables takes corners in any order, and names those it refuses") {
  const std::string four = R"(
    local function model(corners)
      return s.model{
        materials = {{name = "soft", young = 1e5}},
        nodes = {{0, 0, 0, mass = 1}, {1, 0, 0, mass = 1}, {0, 1, 0, mass = 1}, {0, 0, 1, mass = 1},
                 {1, 1, 0.01, mass = 1}},
        springs = {{1, 2, k = 1}, {1, 3, k = 1}, {1, 4, k = 1}, {2, 3, k = 1}, {2, 4, k = 1},
                   {3, 4, k = 1}, {1, 5, k = 1}},
        corners = corners}
    end
  )";
  const Ran ran = run_lua(four + R"(
    local m = model{{nodes = {1, 4, 3, 2}, young = "2 MPa"}}
    print(s.inspect(m:corners()))
    local again = s.model{materials = m.materials, nodes = m:nodes(), springs = m:springs(),
                          corners = m:corners()}
    print(s.inspect(again:corners()) == s.inspect(m:corners()))
    print(model{{nodes = {1, 2, 3, 4}}}:corner(1).young))");
  CAPTURE(ran.err);
  CHECK(ran.out ==
        "{{nodes = {1, 2, 3, 4}, number = 1, volume = 1.0, young = 2000000.0}}\n"
        "true\n"
        "100000.0\n");
  const auto refused = [&](const std::string& corners, const std::string& message) {
    CHECK_THAT(run_lua(four + "model{" + corners + "}").err, Contains(message));
  };
  refused("{nodes = {1, 2, 3}}", "model: corners[1]: nodes must be a list of four node numbers");
  refused("{nodes = {1, 2, 3, 6}}", "model: corners[1]: nodes must be node numbers of 1 to 5");
  refused("{nodes = {1, 2, 3, 5}}",
          "model: corners[1]: nodes must be the nodes of a corner that is not flat");
  refused("{nodes = {1, 2, 3, 3}}",
          "model: corners[1]: nodes must be the nodes of a corner that is not flat");
  refused("{nodes = {5, 2, 4, 1}}", "no spring joins");
  refused("{nodes = {1, 2, 3, 4}, young = 0}", "modulus");
  refused("{nodes = {1, 2, 3, 4}}, {nodes = {1, 3, 2, 4}}", "none twice");
  refused("{node = {1, 2, 3, 4}}", "nodes");
}

TEST_CASE("groups can be given explicitly, by node priority and by pair cost") {
  const Ran ran = run_lua(R"(
    local nodes, springs = {}, {}
    for i = 1, 4 do nodes[i] = {i - 1, 0, 0, mass = 1} end
    for i = 1, 3 do springs[i] = {i, i + 1, k = 100} end
    local m = s.model{nodes = nodes, springs = springs}
    local by_hand = s.simplify(m, {grouping = {{1, 2}, {3, 4}}, levels = 1, guards = false})
    -- The paper's rule: two nodes 2 apart, k = 100 * 1 / 2.
    print(by_hand[1].node_count, by_hand[1]:spring(1).k, by_hand[1]:spring(1).length,
          s.inspect(by_hand:group_map(1)))
    local two_levels = s.simplify(m, {grouping = {{{1, 2}}, {{1, 2}}}, guards = false})
    print(two_levels)
    local pairs_only = s.simplify(m, {levels = 1, guards = false, grouping = function(a, b)
      return a.number == 2 and b.number == 3 and 0 or math.huge
    end})
    print(s.inspect(pairs_only:group_map(1)))
    print(s.simplify(m, {levels = 1, guards = false, node_priority = function(n) return n.x end}))
    print(pcall(s.simplify, m, {levels = 1, grouping = function(a) error("mine") end}))
    print(pcall(s.simplify, m, {levels = 1, grouping = {{1, 2}, {2, 3}}})))");
  CAPTURE(ran.err);
  CHECK_THAT(ran.out, Contains("2\t50.0\t2.0\t{1, 1, 2, 2}\n"));
  CHECK_THAT(ran.out, Contains("LodChain: 4 -> 3 -> 2 nodes, 3 -> 2 -> 1 springs"));
  CHECK_THAT(ran.out, Contains("{1, 2, 2, 3}"));
  CHECK_THAT(ran.out, Contains("false\t") && Contains(": mine"));
}

TEST_CASE("values cannot be forged, changed or mixed up") {
  // With the debug library, of which a sandbox has but the traceback.
  const Ran ran = springlod_run({"-q", "--unsafe", "-e", R"(
    local s = require "springlod"
    local m = s.model{nodes = {{0, 0, 0, mass = 1}}}
    local scene = s.scenario{}
    local function fails(f, ...)
      local ok, failure = pcall(f, ...)
      print(ok, tostring(failure):match("expected a %u%l+") or tostring(failure):match("[^:]*$"))
    end
    fails(s.stable_step, {})
    fails(s.stable_step, io.stdout)
    fails(s.stable_step, scene)
    fails(function() m.mass = 3 end)
    fails(function() return m.weight end)
    fails(setmetatable, m, {})
    print(getmetatable(m), m == m, m ~= scene)
    -- The debug library gets around none of it.
    local meta = debug.getmetatable(m)
    debug.setmetatable(io.stdout, meta)
    fails(s.stable_step, io.stdout)
    local meta_of_scene = debug.getmetatable(scene)
    debug.setmetatable(scene, meta)
    fails(s.stable_step, scene)
    fails(function() return scene.mass end)
    debug.setmetatable(scene, meta_of_scene)
    local kept = s.model{nodes = {{0, 0, 0, mass = 1}}}
    meta.__gc(kept)
    meta.__gc(kept)
    fails(s.stable_step, kept))"});
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out ==
        "false\texpected a Model\n"
        "false\texpected a Model\n"
        "false\texpected a Model\n"
        "false\t a Model cannot be changed; make a new one\n"
        "false\t node_count, spring_count, end_count, corner_count, contact_point_count, "
        "border_count, part_count, mass, volume, center, inertia, bounds, young, materials, level, "
        "made_by, "
        "provenance, node, spring, corner, nodes, springs, corners, inverted_corners\n"
        "false\tbad argument #1 to 'setmetatable' (table expected, got Model)\n"
        "Model\ttrue\ttrue\n"
        "false\texpected a Model\n"
        "false\texpected a Model\n"
        "false\texpected a Model\n"
        "false\texpected a Model\n");
}

TEST_CASE("messages name function, option and expected value") {
  const auto message = [](const std::string& code, const std::string& part) {
    const Ran ran = run_lua("m = s.model{nodes = {{0, 0, 0, mass = 1}}}\n" + code);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(part));
  };
  message("s.simplify(m, {levels = 'two'})",
          "simplify: levels must be a whole number, got \"two\"");
  message("s.simplify(m, {levels = -1})", "levels must be a whole number of 0 to");
  message("s.simplify(m, {guards = 1})", "simplify: guards must be true or false, got 1");
  message("s.simplify(m, {border = 'week'})",
          "must be one of none, weak, strong, got \"week\"; did");
  message("s.simplify(m, {guard = {least = 3}})", "simplify: guard takes: coincident_fraction");
  message("s.simplify(m, 3)", "simplify: expected a table of options");
  message("s.simplify(m, {3})", "options need names");
  message("s.simplify(m, {}, 1)", "simplify takes 2 arguments, got 3");
  message("s.scenario{duration = '3 kg'}", "duration");
  message("s.scenario{gravity = {0, 0}}", "gravity must be a list of three numbers");
  message("s.scenario{throw = {speed = 3}}", "scenario: throw takes: position, velocity");
  message("s.model{nodes = {{0, 0, 0}}}", "model: nodes[1]: mass must be given");
  message("s.model{nodes = {{0, 0, 0, mass = 1}}, springs = {{1, 2, k = 1}}}",
          "model: springs[1]: b must be a node number of 1 to 1");
  message("m.node(1)", "must be called with a colon");
  message("m:node(2)", "bad argument 1 (number) of Model:node");
}

TEST_CASE("JSON has sorted keys, values without JSON form are refused") {
  const Ran ran = run_lua(R"(
    print(s.json({b = {1, 2.5, true}, a = "x\"y", c = {}, d = 1/0}, {indent = -1}))
    local loop = {}
    loop.loop = loop
    print((pcall(s.json, loop)), (pcall(s.json, print)), (pcall(s.json, {[1.5] = 2})))
    print(s.json("a\0b", {indent = -1}))
    print(select(2, pcall(s.json, {1, 2, depth = 3})))
    print(select(2, pcall(s.json, {1, 2, [4] = 3}))))");
  CHECK_THAT(ran.out, StartsWith("{\"a\":\"x\\\"y\",\"b\":[1,2.5,true],\"c\":[],\"d\":null}\n"
                                 "false\tfalse\tfalse\n\"a\\u0000b\"\n"));
  CHECK_THAT(ran.out, Contains("the list entries 1 to 2 and the key 'depth'"));
  CHECK_THAT(ran.out, Contains("the list entries 1 to 2 and the key '4'"));
}
