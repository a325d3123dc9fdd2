#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/cells/depth.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

using namespace springlod::test;
using Catch::Matchers::Contains;

namespace {

VoxelizeOptions with_cell(double cell) {
  VoxelizeOptions options;
  options.cell = cell;
  return options;
}

Vec3 center(const MaterialGrid& grid, std::size_t n) {
  const CellIndex& c = grid.cells[n];
  return grid.origin + grid.cell * Vec3(c[0] + 0.5, c[1] + 0.5, c[2] + 0.5);
}

// The number of cells with the material `name`.
std::size_t count_of(const MaterialGrid& grid, const std::string& name) {
  std::size_t count = 0;
  for (const std::uint16_t m : grid.material) count += grid.materials[m].name == name ? 1 : 0;
  return count;
}

MaterialGrid with_depth(const TriangleMesh& mesh, const VoxelizeOptions& options) {
  MaterialGrid grid = voxelize(mesh, options).grid;
  grid.depth = measure_depth(grid, mesh);
  return grid;
}

double ball_volume(double radius) {
  return 4 * std::numbers::pi / 3 * std::pow(radius, 3);
}

}  // namespace

TEST_CASE("A box of whole cells gives exactly these cells, whatever the rounding of its size") {
  for (const double off : {0.0, 1e-9, -1e-9})
    for (const double at : {0.0, 0.1234567, -1e4}) {
      TriangleMesh mesh;
      const Vec3 low = Vec3::Constant(at);
      add_box(mesh, "beam", low, low + Vec3(4, 4, 20) * (1 + off));
      const VoxelizedMesh result = voxelize(mesh, with_cell(1));
      CHECK(result.grid.cells.size() == 4 * 4 * 20);
      CHECK(result.grid.cells.front() == CellIndex{0, 0, 0});
      CHECK(result.grid.cells.back() == CellIndex{3, 3, 19});
      CHECK((result.grid.origin - low).norm() < 1e-6);
      CHECK(result.report.warnings.empty());
      CHECK(result.report.mesh_volume == Approx(320));
      CHECK(result.report.grid_volume == Approx(320));
    }
}

TEST_CASE("The default cell is the longest side / 32") {
  TriangleMesh mesh;
  add_box(mesh, "beam", {0, 0, 0}, {0.08, 0.08, 0.32});
  const VoxelizedMesh result = voxelize(mesh, {});
  CHECK(result.report.cell_chosen);
  CHECK(result.report.cell == Approx(0.01));
  CHECK(result.grid.cells.size() == 8 * 8 * 32);
  CHECK_FALSE(voxelize(mesh, with_cell(0.02)).report.cell_chosen);
}

TEST_CASE("The cells of a sphere have its volume and are symmetric about its centre") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {5, -3, 2}, 1, 96);
  for (const double cell : {0.05, 2.0 / 31}) {
    const MaterialGrid grid = voxelize(mesh, with_cell(cell)).grid;
    CHECK(static_cast<double>(grid.cells.size()) * std::pow(cell, 3) ==
          Approx(ball_volume(1)).epsilon(0.01));
    Vec3 mean = Vec3::Zero();
    for (std::size_t n = 0; n < grid.cells.size(); ++n)
      mean += center(grid, n) / static_cast<double>(grid.cells.size());
    CHECK((mean - Vec3(5, -3, 2)).norm() < 0.002);
  }
}

TEST_CASE("The depth of a sphere's cells is the radius minus the distance from the centre") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 128);
  const double cell = 0.05;
  const MaterialGrid grid = with_depth(mesh, with_cell(cell));
  REQUIRE(grid.depth.size() == grid.cells.size());
  double worst = 0;
  double mean = 0;
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const double error = std::abs(grid.depth[n] - (1 - center(grid, n).norm()));
    worst = std::max(worst, error);
    mean += error / static_cast<double>(grid.cells.size());
  }
  CHECK(worst < 0.2 * cell);  // documented in depth.hpp
  CHECK(mean < 0.02 * cell);
}

TEST_CASE("The depth of a box's cells is exact") {
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {9, 12, 21});
  const MaterialGrid grid = with_depth(mesh, with_cell(1));
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const Vec3 c = center(grid, n);
    const double depth = std::min(c.minCoeff(), (Vec3(9, 12, 21) - c).minCoeff());
    REQUIRE(grid.depth[n] == Approx(depth).epsilon(1e-5));
  }
}

TEST_CASE("Between touching parts there is no gap and no surface") {
  TriangleMesh mesh;
  add_box(mesh, "left", {0, 0, 0}, {10.5, 9, 9});  // the interface passes through cell centres
  add_box(mesh, "right", {10.5, 0, 0}, {21, 9, 9});
  const MaterialGrid grid = with_depth(mesh, with_cell(1));
  REQUIRE(grid.cells.size() == 21 * 9 * 9);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const Vec3 c = center(grid, n);
    const double depth = std::min(c.minCoeff(), (Vec3(21, 9, 9) - c).minCoeff());
    REQUIRE(grid.depth[n] == Approx(depth).epsilon(1e-5));
  }
}

TEST_CASE(
    "Cells within two parts belong to the first in `priority`, else to the first in the file") {
  TriangleMesh mesh;
  add_box(mesh, "one", {0, 0, 0}, {6, 4, 4});
  add_box(mesh, "two", {4, 0, 0}, {10, 4, 4});
  VoxelizeOptions options = with_cell(1);
  options.materials = {{"one", {{.name = "one"}}}, {"two", {{.name = "two"}}}};
  const MaterialGrid by_file = voxelize(mesh, options).grid;
  CHECK(by_file.cells.size() == 160);
  CHECK(count_of(by_file, "one") == 96);
  CHECK(count_of(by_file, "two") == 64);
  options.priority = {"two"};
  const MaterialGrid by_name = voxelize(mesh, options).grid;
  CHECK(count_of(by_name, "one") == 64);
  CHECK(count_of(by_name, "two") == 96);
  options.priority = {"three"};
  CHECK_THROWS_WITH(voxelize(mesh, options), Contains("\"three\"") && Contains("\"one\", \"two\""));
}

TEST_CASE("A part's material is found by its name, then the file's material, then the fallback") {
  TriangleMesh mesh;
  add_box(mesh, "a", {0, 0, 0}, {2, 2, 2}, "steel");
  add_box(mesh, "b", {2, 0, 0}, {4, 2, 2}, "steel");
  add_box(mesh, "c", {4, 0, 0}, {6, 2, 2}, "wood");
  VoxelizeOptions options = with_cell(1);
  options.materials = {{"a", {{.name = "special"}}},
                       {"steel", {{.name = "", .young = 2e11}}},
                       {"glass", {{.name = "glass"}}}};
  options.fallback = {{.name = "rest"}};
  const VoxelizedMesh result = voxelize(mesh, options);
  CHECK(count_of(result.grid, "special") == 8);
  CHECK(count_of(result.grid, "steel") == 8);
  CHECK(count_of(result.grid, "rest") == 8);
  REQUIRE(result.grid.materials.size() == 3);
  CHECK(result.grid.materials[1].young == 2e11);
  REQUIRE(result.report.warnings.size() == 1);
  CHECK_THAT(result.report.warnings[0], Contains("\"glass\" is not used"));
}

TEST_CASE("Different materials of one name are rejected, equal ones are merged") {
  TriangleMesh mesh;
  add_box(mesh, "a", {0, 0, 0}, {2, 2, 2});
  add_box(mesh, "b", {2, 0, 0}, {4, 2, 2});
  VoxelizeOptions options = with_cell(1);
  options.materials = {{"a", {{.name = "same"}}}, {"b", {{.name = "same"}}}};
  CHECK(voxelize(mesh, options).grid.materials.size() == 1);
  options.materials["b"].material.young = 5;
  CHECK_THROWS_AS(voxelize(mesh, options), InputError);
}

TEST_CASE("In an object of two materials each cell has that of the nearest triangle") {
  TriangleMesh mesh;
  const auto corners = box_corners({0, 0, 0}, {8, 8, 8});
  const auto all = box_triangles();
  // The two triangles of the right side (+x) are blue, the others red.
  add_part(mesh, "box", corners, {all.begin(), all.end() - 2}, "red");
  add_part(mesh, "box", corners, {all.end() - 2, all.end()}, "blue");
  VoxelizeOptions options = with_cell(1);
  options.materials = {{"red", {{.name = "red"}}}, {"blue", {{.name = "blue"}}}};
  const MaterialGrid grid = voxelize(mesh, options).grid;
  REQUIRE(grid.cells.size() == 512);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const Vec3 c = center(grid, n);
    const double to_blue = 8 - c.x();
    const double to_red = std::min({c.x(), c.y(), c.z(), 8 - c.y(), 8 - c.z()});
    if (std::abs(to_blue - to_red) < 1e-9) continue;
    REQUIRE(grid.materials[grid.material[n]].name == (to_blue < to_red ? "blue" : "red"));
  }
}

TEST_CASE("Core and shell are distinguished by depth") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 96);
  VoxelizeOptions options = with_cell(0.05);
  options.fallback = {{.name = "shell"}};
  options.core_shell = {0.4, {{.name = "core", .young = 1e7}}};
  const MaterialGrid grid = voxelize(mesh, options).grid;
  const double core = static_cast<double>(count_of(grid, "core")) * std::pow(0.05, 3);
  CHECK(core == Approx(ball_volume(0.6)).epsilon(0.03));
  CHECK(count_of(grid, "core") + count_of(grid, "shell") == grid.cells.size());
}

TEST_CASE("A paint function receives centre, depth and material of each cell and returns a name") {
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {4, 4, 4});
  VoxelizeOptions options = with_cell(1);
  options.materials = {{"box", {{.name = "plain"}}}, {"top", {{.name = "red"}}}};
  std::vector<Vec3> seen;
  options.paint = [&](const Vec3& at, double depth, const std::string& material) {
    seen.push_back(at);
    CHECK(material == "plain");
    CHECK(depth >= 0.5 - 1e-6);
    if (at.z() > 3) return std::string("top");
    return std::string(at.z() > 2 ? "default" : "");
  };
  const VoxelizedMesh result = voxelize(mesh, options);
  CHECK(count_of(result.grid, "red") == 16);
  CHECK(count_of(result.grid, "default") == 16);
  CHECK(count_of(result.grid, "plain") == 32);
  CHECK(result.report.warnings.empty());
  REQUIRE(seen.size() == 64);
  CHECK(seen[1] == Vec3(1.5, 0.5, 0.5));
  options.paint = [](const Vec3&, double, const std::string&) { return std::string("gold"); };
  CHECK_THROWS_WITH(voxelize(mesh, options), Contains("\"gold\"") && Contains("\"top\""));
}

TEST_CASE("Without repair, an open part is rejected with its name and the position of the hole") {
  TriangleMesh mesh;
  VoxelizeOptions options;
  options.repair = Repair::off;
  auto triangles = box_triangles();
  triangles.erase(triangles.begin() + 2, triangles.begin() + 4);
  add_box(mesh, "good", {0, 0, 0}, {1, 1, 1});
  add_part(mesh, "pot", box_corners({2, 0, 0}, {3, 1, 1}), triangles);
  CHECK_THROWS_AS(voxelize(mesh, options), InputError);
  CHECK_THROWS_WITH(
      voxelize(mesh, options),
      Contains("\"pot\" is not closed: it has 4 boundary edges") && Contains(", 1) m"));
}

TEST_CASE("An inverted sphere is reversed, and reported") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1);
  const std::size_t cells = voxelize(mesh, {}).grid.cells.size();
  turn_inside_out(mesh, mesh.parts[0]);
  const VoxelizedMesh turned = voxelize(mesh, {});
  CHECK(turned.grid.cells.size() == cells);
  REQUIRE(turned.report.repairs.size() == 1);
  CHECK_THAT(turned.report.repairs[0], Contains("\"ball\": all triangles faced inwards"));
  VoxelizeOptions as_is;
  as_is.repair = Repair::off;
  const VoxelizedMesh same = voxelize(mesh, as_is);
  CHECK(same.grid.cells.size() == cells);
  REQUIRE(same.report.warnings.size() == 1);
  CHECK_THAT(same.report.warnings[0], Contains("\"ball\" faced inwards"));
}

TEST_CASE("A cavity stays empty, and its wall counts for the depth") {
  TriangleMesh mesh;
  add_box(mesh, "block", {0, 0, 0}, {10, 10, 10});
  add_box(mesh, "block", {3, 3, 3}, {7, 7, 7});
  turn_inside_out(mesh, mesh.parts[1]);
  const VoxelizedMesh result = voxelize(mesh, with_cell(1));
  CHECK(result.grid.cells.size() == 1000 - 64);
  CHECK(result.report.mesh_volume == Approx(1000 - 64));
  CHECK(result.report.warnings.empty());
  const std::vector<float> depth = measure_depth(result.grid, mesh);
  CHECK(*std::max_element(depth.begin(), depth.end()) < 3);
}

TEST_CASE("A part thinner than a cell and a large volume error give warnings") {
  TriangleMesh mesh;
  add_box(mesh, "block", {0, 0, 0}, {10, 10, 10});
  add_box(mesh, "sheet", {2, 2, 10}, {8, 8, 10.1});
  const VoxelizedMesh result = voxelize(mesh, with_cell(1));
  REQUIRE(result.report.warnings.size() == 1);
  CHECK_THAT(result.report.warnings[0],
             Contains("\"sheet\" is lost: no cell of 1 m has its centre"));
  TriangleMesh plate;
  add_box(plate, "plate", {0, 0, 0}, {10, 10, 1.4});
  const VoxelizedMesh thick = voxelize(plate, with_cell(1));
  REQUIRE(thick.report.warnings.size() == 1);
  CHECK_THAT(thick.report.warnings[0], Contains("\"plate\"") &&
                                           Contains("-29 % (100 m3 against 140 m3 in") &&
                                           Contains("about 1.4 m thick"));
  // Small volumes have a unit that fits.
  TriangleMesh coin;
  add_box(coin, "coin", {0, 0, 0}, {0.1, 0.1, 0.0014});
  const VoxelizedMesh thin = voxelize(coin, with_cell(1e-3));
  REQUIRE(thin.report.warnings.size() == 1);
  CHECK_THAT(thin.report.warnings[0], Contains("(10 cm3 against 14 cm3 in the mesh)"));
}

TEST_CASE("Cells too large, too small or not positive are rejected with a valid value") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1);
  CHECK_THROWS_AS(voxelize(mesh, with_cell(0)), InputError);
  CHECK_THROWS_AS(voxelize(mesh, with_cell(std::nan(""))), InputError);
  CHECK_THROWS_WITH(voxelize(mesh, with_cell(1e-4)), Contains("use a cell of 0.004"));
  CHECK_THROWS_WITH(voxelize(mesh, with_cell(1e-300)), Contains("use a cell of"));
  CHECK_THROWS_WITH(voxelize(mesh, with_cell(4.1)),
                    Contains("twice as long as the whole mesh, 2 m"));
  TriangleMesh frame;  // two bars, far apart: the middle cell of the box is empty
  add_box(frame, "a", {0, 0, 0}, {10, 0.1, 0.1});
  add_box(frame, "b", {0, 9.9, 9.9}, {10, 10, 10});
  CHECK_THROWS_WITH(voxelize(frame, with_cell(10)), Contains("use a smaller cell, say 2.5 m"));
}

TEST_CASE("Vertices that are not finite, far away or coplanar are rejected") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1);
  TriangleMesh bad = mesh;
  bad.positions[7].y() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(voxelize(bad, {}), InputError);
  bad = mesh;
  bad.positions[7].y() = 1e7;
  CHECK_THROWS_WITH(voxelize(bad, with_cell(0.05)), Contains("stray vertex"));
  bad = mesh;
  for (Vec3& p : bad.positions) p.x() += 1e8;
  CHECK_THROWS_WITH(voxelize(bad, {}), Contains("from the origin"));
  TriangleMesh flat;
  add_box(flat, "flat", {0, 0, 0}, {1, 1, 0});
  CHECK_THROWS_WITH(voxelize(flat, {}), Contains("flat"));
  CHECK_THROWS_AS(voxelize(TriangleMesh{}, {}), InputError);
}

TEST_CASE("Depth is measured if a core or a paint function needs it, otherwise on request") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 24);
  add_box(mesh, "box", {0.5, -0.5, -0.5}, {2, 0.5, 0.5});
  VoxelizeOptions options = with_cell(0.1);
  const MaterialGrid plain = voxelize(mesh, options).grid;
  CHECK(plain.depth.empty());
  const std::vector<float> depth = measure_depth(plain, mesh);
  REQUIRE(depth.size() == plain.cells.size());

  options.core_shell = {0.3, {{.name = "core"}}};
  const MaterialGrid cored = voxelize(mesh, options).grid;
  CHECK(cored.depth == depth);
  for (std::size_t n = 0; n < depth.size(); ++n)
    REQUIRE((cored.materials[cored.material[n]].name == "core") == (depth[n] > 0.3));

  options.core_shell.reset();
  std::vector<float> seen;
  options.paint = [&](const Vec3&, double at, const std::string&) {
    seen.push_back(static_cast<float>(at));
    return std::string();
  };
  CHECK(voxelize(mesh, options).grid.depth == depth);
  CHECK(seen == depth);
}

TEST_CASE("One thread and two give the same grid") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 64);
  add_sphere(mesh, "other", {0.7, 0.2, 0.1}, 1, 64);
  for (int i = 0; i < 12; ++i)  // more solids than are processed at once
    add_box(mesh, "box " + std::to_string(i), {-1 + 0.2 * i, -1.5, -1}, {-0.7 + 0.2 * i, 0, 1.5});
  const auto run = [&](std::uint32_t threads) {
    VoxelizeOptions options = with_cell(0.03);
    options.threads = threads;
    options.materials = {{"ball", {{.name = "ball"}}}, {"other", {{.name = "other"}}}};
    options.priority = {"box 7", "ball"};
    options.core_shell = {0.4, {{.name = "core"}}};
    return voxelize(mesh, options);
  };
  const VoxelizedMesh one = run(1);
  REQUIRE(one.grid.cells.size() > 10000);
  for (const std::uint32_t threads : {2U, 5U, 0U}) {
    const VoxelizedMesh more = run(threads);
    CHECK(one.grid.cells == more.grid.cells);
    CHECK(one.grid.material == more.grid.material);
    CHECK(one.grid.depth == more.grid.depth);
    CHECK(one.report.warnings == more.report.warnings);
    CHECK(one.report.mesh_volume == more.report.mesh_volume);
  }
}

TEST_CASE("An interrupt ends the filling of many parts") {
  struct Impatient : Progress {
    int seen = 0;
    void advance(std::uint64_t) override {
      if (++seen == 3) throw InterruptedError();
    }
  };
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    add_box(mesh, "box " + std::to_string(i), {2. * i, 0, 0}, {2. * i + 1, 1, 1});
  Impatient progress;
  VoxelizeOptions options = with_cell(0.1);
  options.threads = GENERATE(1U, 2U);
  options.progress = &progress;
  CHECK_THROWS_AS(voxelize(mesh, options), InterruptedError);
  CHECK(progress.seen == 3);
}

}  // namespace springlod::voxelize
