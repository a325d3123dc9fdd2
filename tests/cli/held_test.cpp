// Bodies that are held, from scripts and from the command line.
#include <catch2/catch.hpp>

#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::make_bar_asset;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::spit;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

/// Runs a script that has `s`, a block `base` of 5 x 2 x 2 cells of 1 cm along x, and `low` and
/// `high`, which hold its ends.
Ran run_script(const TemporaryFolder& scratch, const std::string& script) {
  spit(scratch / "script.lua", R"(
    local s = require "springlod"
    local base = s.lattice(s.grid{cell = "1 cm", size = {5, 2, 2},
      fill = function() return "gel" end,
      materials = {gel = {young = "100 kPa", density = 1000, damping = 0.01}}})
    local least, most = base.bounds.low[1], base.bounds.high[1]
    local function low(node) return node.x < least + 1e-6 end
    local function high(node) return node.x > most - 1e-6 end
  )" + script);
  return springlod_run({"run", (scratch / "script.lua").string()});
}

void require_success(const Ran& ran) {
  CAPTURE(ran.out, ran.err);
  REQUIRE(ran.exit_code == 0);
}

}  // namespace

TEST_CASE("A script holds a body in runs, ensembles, comparisons and stability maps") {
  const TemporaryFolder scratch;
  require_success(run_script(scratch, R"(
    local scene = s.scenario{duration = 1.5, gravity = {9.81, 0, 0}}
    local hung = s.run(base, scene, {anchored = low, frame_rate = 10})
    local weight = 9.81 * base.mass
    local load = hung.anchor_loads[#hung][1]
    assert(load.name == "anchor 1")
    assert(math.abs(load.force[1] + weight) < 0.01 * weight, load.force[1])
    assert(math.abs(load.work) < 1e-9)

    local jaws = {
      {name = "still", nodes = low},
      {name = "jaw", nodes = high, path = {
        {time = 0.2, move = {"5 mm", 0, 0}, turn = {axis = {1, 0, 0}, angle = "400 deg"}},
        {time = 0.4, move = {"5 mm", 0, 0}},
      }},
    }
    local free = {duration = 1, gravity = {0, 0, 0}}
    local turned = s.run(base, free, {anchored = jaws, integrator = "velocity_verlet"})
    local ledger = turned.ledger[#turned]
    local jaw = turned.anchor_loads[#turned][2]
    assert(jaw.name == "jaw" and jaw.force[1] > 0)
    assert(math.abs(jaw.work - ledger.anchor_work) < 0.02 * ledger.anchor_work)
    -- The stiffness along the bar is that of deflect with the same anchors.
    local first = s.deflect(base, {anchored = low,
      force = function(node) if high(node) then return {1, 0, 0} end end})
    assert(#first.displacement == base.node_count)

    local frequency = s.modes(base, {count = 1, anchored = jaws})[1].frequency
    assert(frequency > s.modes(base, {count = 1, anchored = low})[1].frequency)
    assert(#s.zero_modes(base, {anchored = jaws}) == 1)

    local chain = s.simplify(base, {levels = 1, calibrate = "modes",
                                    calibration = {anchored = jaws}})
    local compared = s.compare(chain, free, {anchored = jaws})
    assert(compared:table()[2].ledger_error < 0.05)
    local runs = s.ensemble(chain[1], free, {starts = 2, anchored = chain:carried(1, low)})
    assert(#runs == 2)
    local map = s.stability(chain, {ratios = {1}, steps = {0.5}, integrators = {"symplectic_euler"},
                                    anchored = jaws})
    local held, loose = map:bodies()[1].period, s.stability(chain, {ratios = {1}, steps = {0.9},
      integrators = {"symplectic_euler"}}):bodies()[1].period
    assert(math.abs(held * frequency - 1) < 1e-6, held)
    assert(held ~= loose)
    assert(map:table()[1].verdict == "stable", map:table()[1].verdict)
  )"));
}

TEST_CASE("A script pulls a body by springs, in runs, levels, modes and equilibria alike") {
  const TemporaryFolder scratch;
  require_success(run_script(scratch, R"(
    local hand = {name = "hand", nodes = high, stiffness = 20, damping = "20 ms",
                  path = {{time = 0.3, move = {"1 cm", 0, 0}}}}
    local anchors = {{name = "still", nodes = low}, hand}
    local free = {duration = 2, gravity = {0, 0, 0}}
    local pulled = s.run(base, free, {anchored = anchors, frame_rate = 10})
    local still = s.deflect(base, {large = true, anchored = anchors})
    local load, wanted = pulled.anchor_loads[#pulled][2], still.anchor_loads[2]
    assert(wanted.force[1] > 0.05 and wanted.force[1] < 0.2, wanted.force[1])
    assert(math.abs(load.force[1] / wanted.force[1] - 1) < 0.01, load.force[1])
    local ledger = pulled.ledger[#pulled]
    assert(ledger.anchors > 0 and ledger.lost_anchors > 0)
    assert(ledger.anchors + ledger.elastic < still.energy * 1.02)

    -- In a level, the springs are as stiff.
    local chain = s.simplify(base, {levels = 1, calibrate = "modes",
                                    calibration = {anchored = anchors}})
    local compared = s.compare(chain, free, {anchored = anchors})
    assert(compared:table()[2].surface_error < 2e-4, compared:table()[2].surface_error)

    local first = s.modes(base, {count = 1, anchored = anchors})[1].frequency
    assert(first > s.modes(base, {count = 1, anchored = low})[1].frequency)
    assert(first < s.modes(base, {count = 1, anchored = {anchors[1], {nodes = high}}})[1].frequency)
    assert(s.zero_modes(base, {anchored = {hand}})[1].zero_modes == 0)
    hand.path = nil
    local bent = s.deflect(base, {anchored = {hand}, force = {[1] = {0, 0, 1e-3}}})
    assert(math.abs(bent.anchor_loads[1].force[3] + 1e-3) < 1e-9)

    hand.stiffness = nil
    local ok, failure = pcall(s.run, base, free, {anchored = {hand}})
    assert(not ok and failure.message:find("stiffness must be given with damping", 1, true),
           failure.message)
    hand.stiffness = 0
    assert(not pcall(s.run, base, free, {anchored = {hand}}))
  )"));
}

TEST_CASE("A script finds equilibria far from rest, of a level too") {
  const TemporaryFolder scratch;
  require_success(run_script(scratch, R"(
    local function pull(newtons)
      return function(node) if high(node) then return {0, 0, newtons} end end
    end
    local small = s.deflect(base, {anchored = low, force = pull(1e-6)})
    local large = s.deflect(base, {anchored = low, force = pull(1e-6), large = true})
    local last = base.node_count
    local ratio = large.displacement[last][3] / small.displacement[last][3]
    assert(math.abs(ratio - 1) < 1e-3, ratio)
    assert(math.abs(small.anchor_loads[1].force[3] + 9e-6) < 1e-11)
    assert(math.abs(large.anchor_loads[1].force[3] + 9e-6) < 1e-11)
    assert(math.abs(2 * small.energy - small.compliance) < 1e-9 * small.compliance)

    local jaws = {{nodes = low}, {name = "jaw", nodes = high,
      path = {{time = 1, turn = {axis = {1, 0, 0}, angle = "90 deg"}}}}}
    local turned = s.deflect(base, {large = true, anchored = jaws})
    assert(turned.anchor_loads[2].name == "jaw" and turned.anchor_loads[2].torque[1] > 0)
    assert(math.abs(turned.anchor_loads[1].torque[1] + turned.anchor_loads[2].torque[1])
           < 1e-6 * turned.anchor_loads[2].torque[1])
    assert(turned.energy > 0 and turned.residual <= 1e-9 and turned.load_steps >= 1)
    assert(turned.iterations >= turned.load_steps)

    -- A run with the same anchors comes to rest there.
    local run = s.run(base, {duration = 4, gravity = {0, 0, 0}}, {anchored = jaws})
    local torque = run.anchor_loads[#run][2].torque[1]
    assert(math.abs(torque / turned.anchor_loads[2].torque[1] - 1) < 0.01, torque)

    local chain = s.simplify(base, {levels = 1})
    local of_level = s.deflect(chain[1], {large = true, anchored = chain:carried(1, low),
                                          force = {[chain[1].node_count] = {0, 0, 1e-3}}})
    local of_base = chain:to_base(1, of_level.displacement)
    assert(#of_base == base.node_count and of_base[last][3] > 0)
    assert(#chain:to_base(0, large.displacement) == last)
    assert(not pcall(chain.to_base, chain, 1, {{0, 0, 0}}))
    local moves, message = pcall(s.deflect, base, {anchored = jaws})
    assert(not moves and message.message:find("large"), message.message)
  )"));
}

TEST_CASE("What cannot be held is refused with a reason") {
  const TemporaryFolder scratch;
  const auto refuses = [&](const std::string& anchored, const std::string& words) {
    const Ran ran =
        run_script(scratch, "s.run(base, {duration = 0.01}, {anchored = " + anchored + "})");
    CAPTURE(anchored);
    CHECK(ran.exit_code == 1);
    CHECK_THAT(ran.err, Contains(words));
  };
  refuses("function(node) return node.x > 100 end", "is true for none of the 54 nodes");
  refuses("{55}", "anchored[1] must be a node number of 1 to 54");
  refuses("{{name = 'x'}}", "nodes must be given");
  refuses("{{nodes = low}, {nodes = {1}}}", "anchors \"anchor 1\" and \"anchor 2\" both hold node");
  refuses("{{nodes = low, path = {{move = {1, 0, 0}}}}}", "time must be given");
  refuses("{{nodes = low, path = {{time = 2}, {time = 1}}}}", "must be later than 2 s");
  refuses("{{nodes = low, speed = 2}}", "speed");
  refuses("'left'", "must be a list of node numbers or a function of a node");
}

TEST_CASE("compare and stability take anchors from files") {
  const TemporaryFolder scratch;
  make_bar_asset(scratch / "bar.glb", 3, {"--cell", "0.25", "--levels", "1"});
  spit(scratch / "held.lua", "return function(node) return node.x < 0.1 end");
  spit(scratch / "scene.lua",
       "return {duration = 0.05, anchored = {{nodes = function(node) return node.x < 0.1 end, "
       "path = {{time = 0.04, move = {0, 0, 0.1}}}}}}");
  const Ran compared = springlod_run({"compare", (scratch / "bar.glb").string(), "--scenario",
                                      (scratch / "scene.lua").string(), "--out",
                                      (scratch / "compared").string(), "--frames", "0"});
  require_success(compared);
  CHECK_THAT(slurp(scratch / "compared/table.csv"), Contains("level 1"));
  CHECK_THAT(compared.err, Contains("ran one start instead of 8"));
  CHECK_THAT(compared.out, Contains("Means over 1 start."));
  const Ran mapped =
      springlod_run({"stability", (scratch / "bar.glb").string(), "--out",
                     (scratch / "map").string(), "--ratios", "1", "--steps", "0.9", "--integrators",
                     "symplectic_euler", "--anchored", (scratch / "held.lua").string()});
  require_success(mapped);
  CHECK_THAT(slurp(scratch / "map/map.csv"), Contains("symplectic_euler"));
}
