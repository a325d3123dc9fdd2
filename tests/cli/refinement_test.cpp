// springlod refinement, and anchored bodies in scripts.

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>

#include <catch2/catch.hpp>

#include "tests/support/paths.hpp"
#include "tests/support/program.hpp"

using Catch::Matchers::Contains;
using springlod::test::Ran;
using springlod::test::slurp;
using springlod::test::springlod_run;
using springlod::test::TemporaryFolder;

namespace {

/// Errors in percent of tip deflection, f1, f2, f3.
using Errors = std::array<double, 4>;

/// Errors by the number of cells across.
std::map<int, Errors> errors_of(const std::string& table, const std::string& style) {
  std::map<int, Errors> found;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    if (cell != style) continue;
    std::getline(cells, cell, ',');
    Errors& errors = found[std::stoi(cell)];
    std::getline(cells, cell, ',');  // nodes
    for (double& error : errors) {
      std::getline(cells, cell, ',');
      error = std::stod(cell);
    }
  }
  return found;
}

void check_falling(const std::map<int, Errors>& by_cells) {
  for (auto coarse = by_cells.begin(), fine = std::next(coarse); fine != by_cells.end();
       ++coarse, ++fine)
    for (std::size_t i = 0; i < 4; ++i) {
      INFO(fine->first << " cells, value " << i);
      CHECK(std::abs(fine->second.at(i)) < std::abs(coarse->second.at(i)));
    }
}

Ran with_bar(const std::string& script) {
  return springlod_run({"-e", std::string("local s = require 'springlod'\n"
                                          "local mesh = s.import('") +
                                  springlod::test::source_folder().string() +
                                  "/samples/dumbbell.obj', {unit = 'dm'})\n"
                                  "local bar = s.lattice(s.voxelize(mesh, {cell = '20 cm'}))\n"
                                  "local function held(node) return node.x < bar:node(1).x + 0.01 "
                                  "end\n" +
                                  script});
}

}  // namespace

TEST_CASE("refinement without a folder writes to out/refinement") {
  const TemporaryFolder current;
  const Ran ran = springlod_run({"-q", "refinement", "--finest", "3"}, "", current.path());
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(std::filesystem::exists(current / "out/refinement/table.csv"));
}

TEST_CASE("refinement --quick: errors decrease with the cell size, with order 2 for corners") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"refinement", out.path().string(), "--quick"});
  CAPTURE(ran.err);
  REQUIRE(ran.exit_code == 0);
  const std::string table = slurp(out / "table.csv");
  const auto corners = errors_of(table, "corners"), centers = errors_of(table, "centers");
  REQUIRE(corners.size() == 4);
  REQUIRE(centers.size() == 3);
  check_falling(corners);
  check_falling(centers);
  for (std::size_t i = 0; i < 4; ++i) {
    // Asymptotically of second order; at three and four cells, higher-order terms and the small
    // constant error of the clamp reduce the observed order.
    const double order = std::log(corners.at(3).at(i) / corners.at(4).at(i)) / std::log(4.0 / 3);
    CHECK(order > 1.6);
    CHECK(order < 2);
    // Springs on the border of `centers` are as stiff as inner ones: at most first order.
    CHECK(std::abs(centers.at(4).at(i)) > 3 * std::abs(corners.at(4).at(i)));
  }
  CHECK_THAT(ran.out, Contains("f1 0.40308, f2 2.4978, f3 6.8728 Hz"));
  CHECK_THAT(ran.out, Contains("order towards own limit"));
  CHECK(slurp(out / "orders.csv").find("nan") == std::string::npos);
}

TEST_CASE("refinement: with eight cells across, all values are within 2 % of Timoshenko",
          "[long]") {
  const TemporaryFolder out;
  const Ran ran = springlod_run({"-q", "refinement", out.path().string(), "--finest", "8"});
  REQUIRE(ran.exit_code == 0);
  const auto corners = errors_of(slurp(out / "table.csv"), "corners");
  check_falling(corners);
  for (const double error : corners.at(8)) CHECK(std::abs(error) < 2);
}

TEST_CASE("a script anchors nodes by number or by a function, and applies forces") {
  const Ran ran = with_bar(R"(
    local numbers = {}
    for _, node in ipairs(bar:nodes()) do
      if held(node) then numbers[#numbers + 1] = node.number end
    end
    local last = bar.node_count
    local by_function = s.deflect(bar, {anchored = held, force = {[last] = {0, 0, -2}}})
    local by_number = s.deflect(bar, {anchored = numbers, force = function(node)
      if node.number == last then return {0, 0, -2} end
    end})
    for i, u in ipairs(by_function.displacement) do
      for d = 1, 3 do assert(u[d] == by_number.displacement[i][d]) end
    end
    assert(by_function.displacement[last][3] < 0 and by_function.displacement[numbers[1]][3] == 0)
    assert(math.abs(by_function.compliance + 2 * by_function.displacement[last][3])
      < 1e-9 * by_function.compliance)
    assert(s.modes(bar, {count = 1, anchored = held})[1].frequency
      < s.modes(bar, {count = 1})[1].frequency)
    assert(s.static_loads(bar, {anchored = held})[1].displacement[numbers[1]][1] == 0)
    local part = s.zero_modes(bar, {anchored = held})[1]
    print(part.zero_modes, part.expected, part.anchored == #numbers)
    local chain = s.simplify(bar, {levels = 1})
    local map, coarse = chain:group_map(1), chain:carried(1, held)
    local there = {}
    for _, node in ipairs(coarse) do there[node] = true end
    for _, node in ipairs(numbers) do assert(there[map[node]]) end
    assert(#coarse < #numbers)
    assert(s.deflect(chain[1], {anchored = coarse, force = {[map[last]] = {0, 0, -2}}}).compliance > 0))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  CHECK(ran.out == "0\t0\ttrue\n");
}

TEST_CASE("invalid anchors and forces are refused with their position") {
  const Ran ran = with_bar(R"(
    print(pcall(s.deflect, bar, {anchored = held}))
    print(pcall(s.deflect, bar, {anchored = {0}, force = {}}))
    print(pcall(s.deflect, bar, {anchored = 1, force = {}}))
    print(pcall(s.deflect, bar, {anchored = held, force = {a = {0, 0, 1}}}))
    print(pcall(s.deflect, bar, {anchored = held, force = {[2] = 1}}))
    print(pcall(s.deflect, bar, {anchored = held, force = function(node) return node.x end}))
    print(pcall(s.modes, bar, {anchored = function(node) return node.x > 1e3 end}))
    print(pcall(s.deflect, bar, {anchored = {1}, force = {[2] = {0, 0, 1}}}))
    print(#s.modes(bar, {anchored = {1}, count = 2})))");
  CAPTURE(ran.err);
  CHECK(ran.exit_code == 0);
  for (const char* message :
       {"force must be given", "anchored[1] must be a node number of 1 to",
        "anchored must be a list of node numbers or a function of a node, got",
        "force: its keys must be a node number", "force[2] must be a list of three numbers",
        "force of node 1 must be a list of three numbers", "anchored is true for none of the",
        "anchor more nodes", "\n2\n"})
    CHECK_THAT(ran.out, Contains(message));
  CHECK_THAT(ran.err, Contains("the anchors leave 3 zero modes"));
}
