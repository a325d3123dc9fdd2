// Grids by formula, random models, refilled levels and eq. 2 in scripts.

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::springlod_run;

namespace {

const std::string kGrid = std::string("local s = require 'springlod'\nlocal mesh = s.import('") +
                          springlod::test::source_folder().string() +
                          "/samples/dumbbell.obj', {unit = 'dm'})\n"
                          "local grid = s.voxelize(mesh, {cell = '10 cm'})\n";

Ran with_grid(const std::string& script) {
  return springlod_run({"-e", kGrid + script});
}

}  // namespace

TEST_CASE("a script builds a random model, simplifies it and reads the measurements") {
  const Ran ran = with_grid(R"(
    local model = s.random(grid, {nodes = 300, seed = 2})
    assert(model.node_count == 300 and model.spring_count == 2700)
    assert(math.abs(model.volume - grid.volume) < 1e-9)
    assert(tonumber(model.provenance.rescaled) > 1)
    assert(math.abs(tonumber(model.provenance.measured_poisson) - 0.25) < 0.03)
    local chain = s.simplify(model, {levels = 1, mass = "proximity"})
    assert(math.abs(chain[1].mass - model.mass) < 1e-9 * model.mass)
    print(model.made_by, chain.provenance.random))");
  CHECK(ran.err.find("error") == std::string::npos);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("random, 300 nodes, 18 ends, seed 2"));
}

TEST_CASE("the depth of cells is available in scripts and .vdb files") {
  const Ran ran = with_grid(R"(
    local path = os.tmpname()
    local cored = s.voxelize(mesh, {cell = "10 cm", core = {depth = "15 cm",
                                                            material = {young = "1 MPa"}}})
    s.save_vdb(path, grid)
    local cells, core_cells, loaded = grid.cells, cored.cells, s.load_vdb(path).cells
    local deep = 0
    for i, cell in ipairs(cells) do
      assert(cell.depth > 0 and cell.depth == core_cells[i].depth)
      assert(cell.depth == loaded[i].depth)
      if cell.depth > 0.15 then deep = deep + 1 end
    end
    assert(deep > 0)
    local by_hand = s.grid{cell = 1, size = {1, 1, 1}, materials = {m = {young = 1}},
                           surface = mesh, fill = function() return "m" end}
    assert(by_hand.cells[1].depth == nil)
    os.remove(path)
    print("all depths agree"))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("all depths agree"));
}

TEST_CASE("a script refills a grid and reads the node count that a lattice reached") {
  const Ran ran = with_grid(R"(
    local base = s.lattice(grid)
    local chain = s.refill(base, grid, {nodes = {200, 70}, style = "random", seed = 1})
    assert(chain[1].node_count == 200 and chain[2].node_count == 70)
    for _, node in ipairs(chain:group_map(2)) do assert(node >= 1 and node <= 70) end
    assert(math.abs(s.refill(base, grid, {nodes = 211})[1].mass - base.mass) < 1e-9 * base.mass)
    print(chain[1].made_by))");
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out + ran.err, Contains("refill random, 200 nodes"));
  CHECK_THAT(ran.out + ran.err, Contains("the nearest to 211 that a lattice has"));
  const Ran wrong = with_grid("s.refill(s.lattice(grid), grid, {nodes = {'many'}})");
  CHECK(wrong.exit_code == 1);
  CHECK_THAT(wrong.err, Contains("refill: nodes[1]: \"many\" does not start with a number"));
  CHECK_THAT(with_grid("s.refill(s.lattice(grid), grid)").err, Contains("refill: nodes must be"));
}

TEST_CASE("a script reads eq. 2 of the whole, of each material and of each node") {
  const Ran ran = with_grid(R"(
    local model = s.lattice(grid)
    local e = s.estimate(model)
    assert(#e.node_young == model.node_count and #e.node_density == model.node_count)
    assert(math.abs(e.young - model.young) < 1e-6 and e.materials[1].nodes == model.node_count)
    print(e.materials[1].name, math.floor(e.young + 0.5), math.floor(e.density + 0.5)))");
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "default\t1000000\t1000\n");
}

TEST_CASE("a script reads the corners of a model and leaves them out") {
  const Ran ran = with_grid(R"(
    local function count(model) return model.corner_count end
    local base = s.lattice(grid)
    assert(count(base) == 8 * grid.cell_count and #base:corners() == count(base))
    local corner = base:corner(1)
    assert(corner.number == 1 and #corner.nodes == 4 and corner.nodes[1] == 1)
    assert(math.abs(corner.volume - 1e-3) < 1e-12 and corner.young == 1e6)
    local chain = s.simplify(base, {levels = 1})
    assert(count(chain[1]) > chain[1].node_count)
    assert(s.info(chain).levels[2].corners == count(chain[1]))
    assert(count(s.lattice(grid, {volumes = false})) == 0)
    assert(s.lattice(grid, {volumes = false}).provenance.volumes == "false")
    assert(count(s.lattice(grid, {style = "centers"})) > 0)
    assert(count(s.random(grid, {nodes = 200})) > 200)
    assert(count(s.random(grid, {nodes = 200, volumes = false})) == 0)
    assert(count(s.refill(base, grid, {nodes = {200}})[1]) > 0)
    assert(count(s.refill(base, grid, {nodes = {200}, volumes = false})[1]) == 0)
    print(base)
    print(s.lattice(grid, {volumes = false})))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains(" springs, 2944 corners, ") && Contains(" springs, 368 kg"));
}

TEST_CASE("a script finds the corners that a state turns over") {
  const Ran ran = with_grid(R"(
    local base = s.lattice(grid)
    local x = {}
    for i, node in ipairs(base:nodes()) do x[i] = {node.x, node.y, node.z} end
    assert(#base:inverted_corners{x = x} == 0 and #base:inverted_corners{} == 0)
    local away = base:node(1)
    x[1] = {away.x + 0.15, away.y, away.z}
    for _, number in ipairs(base:inverted_corners{x = x}) do
      local nodes = base:corner(number).nodes
      print(number, nodes[1])
    end
    print(pcall(base.inverted_corners, base, {x = {{0, 0, 0}}}))
    local still = s.run(base, s.scenario{duration = 0.01})
    print(#base:inverted_corners(still.final), #base:inverted_corners(still[1])))");
  CAPTURE(ran.err, ran.out);
  CHECK(ran.exit_code == 0);
  CHECK_THAT(ran.out, Contains("1\t1\n"));
  CHECK_THAT(ran.out, Contains("model:inverted_corners: state.x must be a list of"));
  CHECK_THAT(ran.out, Contains("0\t0\n"));
}

TEST_CASE("a script fills a grid by a formula, and errors in it are reported") {
  const std::string bar =
      "{cell = '10 cm', size = {2, 2, 6}, origin = {0, 0, -0.3},"
      " materials = {stiff = {young = '1 MPa'}, soft = {young = '0.1 MPa'}}, fill = ";
  const Ran ran =
      springlod_run({"-e", "local s = require 'springlod'; local grid = s.grid" + bar + R"(
    function(_, _, z) if z < 0.2 then return z < 0 and 'stiff' or 'soft' end end}
    print(grid.cell_count, grid.min[3], #grid.materials)
    print(s.lattice(grid, {style = 'centers'}).node_count))"});
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "20\t-0.3\t2\n20\n");
  const auto refused = [&](const std::string& fill) {
    return springlod_run({"-e", "require 'springlod'.grid" + bar + fill + "}"}).err;
  };
  CHECK_THAT(refused("function() return 'iron' end"), Contains("'iron', which materials does not"));
  CHECK_THAT(refused("function() return 3 end"), Contains("it returned a number"));
  CHECK_THAT(refused("function() end"), Contains("all of the 2 x 2 x 6 cells empty"));
  CHECK_THAT(refused("function() error('own fault') end"), Contains("own fault"));
  CHECK_THAT(refused("1"), Contains("fill must be a function"));
}
