// Cells by the fraction that is inside, and points of the surface.
#include <cmath>
#include <map>
#include <numbers>
#include <random>

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "base/error.hpp"
#include "tests/voxelize/shapes.hpp"
#include "voxelize/cells/depth.hpp"
#include "voxelize/cells/fractions.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

using namespace springlod::test;

namespace {

VoxelizeOptions cut(double cell) {
  VoxelizeOptions options;
  options.cell = cell;
  options.cut_cells = true;
  return options;
}

double surface_area(const MaterialGrid& grid) {
  double area = 0;
  for (const SurfacePoint& point : grid.surface) area += point.area;
  return area;
}

Vec3 position(const MaterialGrid& grid, const SurfacePoint& point) {
  return grid.center(point.cell) + grid.cell * Vec3(point.place[0], point.place[1], point.place[2]);
}

Vec3 normal(const SurfacePoint& point) {
  return {point.normal[0], point.normal[1], point.normal[2]};
}

TriangleMesh turned_box(const Vec3& size, const Mat3& rotation) {
  TriangleMesh mesh;
  add_box(mesh, "box", -size / 2, size / 2);
  for (Vec3& p : mesh.positions) p = rotation * p;
  return mesh;
}

}  // namespace

TEST_CASE("A plane cuts a cube into the fractions that geometry gives") {
  CHECK(cut_cube({0, 0, 1}, 0) == Approx(0.5));
  CHECK(cut_cube({0, 0, 1}, 0.25) == Approx(0.25).epsilon(1e-3));
  CHECK(cut_cube({0, -1, 0}, -0.5) == Approx(1));
  CHECK(cut_cube({1, 0, 0}, 0.5) == Approx(0).margin(1e-9));
  // Half along an edge's diagonal; a corner of a third of a diagonal.
  CHECK(cut_cube({1, 1, 0}, 0) == Approx(0.5));
  CHECK(cut_cube({1, 1, 1}, 0.5) == Approx(1. / 6));
  CHECK(cut_cube({1, 1, 1}, -0.5) == Approx(5. / 6));
}

TEST_CASE("The fractions of a cut cube are those of samples, and of both sides add up to 1") {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int i = 0; i < 40; ++i) {
    const Vec3 direction = Vec3(number(random), number(random), number(random)).normalized();
    const double distance = 0.7 * number(random);
    int inside = 0;
    constexpr int kSamples = 40;
    for (int x = 0; x < kSamples; ++x)
      for (int y = 0; y < kSamples; ++y)
        for (int z = 0; z < kSamples; ++z) {
          const Vec3 at = (Vec3(x, y, z) + Vec3::Constant(0.5)) / kSamples - Vec3::Constant(0.5);
          inside += direction.dot(at) <= -distance ? 1 : 0;
        }
    const double fraction = cut_cube(direction, distance);
    CHECK(fraction == Approx(inside / std::pow(kSamples, 3)).margin(0.01));
    CHECK(fraction + cut_cube(-direction, -distance) == Approx(1).epsilon(1e-12));
  }
}

TEST_CASE("The cut cells of a ball have its volume, and the points of its surface lie on it") {
  TriangleMesh mesh;
  const Vec3 center(0.1, -0.2, 0.33);
  add_sphere(mesh, "ball", center, 1, 96);
  const VoxelizedMesh result = voxelize(mesh, cut(2. / 17));
  const MaterialGrid& grid = result.grid;
  validate(grid);
  CHECK(result.report.warnings.empty());
  CHECK(volume(grid) == Approx(result.report.mesh_volume).epsilon(2e-4));
  CHECK(result.report.grid_volume == volume(grid));
  CHECK(surface_area(grid) == Approx(4 * std::numbers::pi).epsilon(2e-3));
  Vec3 sum = Vec3::Zero();
  for (const SurfacePoint& point : grid.surface) {
    const Vec3 arm = position(grid, point) - center;
    CHECK(arm.norm() == Approx(1).epsilon(2e-3));
    CHECK(arm.normalized().dot(normal(point)) > 0.995);
    CHECK(point.area < 2 * grid.cell * grid.cell);
    sum += point.area * normal(point);
  }
  CHECK(sum.norm() < 1e-3);
  // About four points for each cell of the surface.
  const double cells = surface_area(grid) / (grid.cell * grid.cell);
  CHECK(static_cast<double>(grid.surface.size()) > 3 * cells);
  CHECK(static_cast<double>(grid.surface.size()) < 9 * cells);
}

TEST_CASE("Cut cells of a box of whole cells are whole") {
  TriangleMesh mesh;
  add_box(mesh, "box", {0, 0, 0}, {4, 3, 5});
  const MaterialGrid grid = voxelize(mesh, cut(1)).grid;
  CHECK(grid.cells.size() == 4 * 3 * 5);
  for (const float fraction : grid.fraction) CHECK(fraction == 1);
  CHECK(surface_area(grid) == Approx(2 * (4 * 3 + 3 * 5 + 5 * 4)));
  // Faces keep apart at the edges: no normal is slanted.
  for (const SurfacePoint& point : grid.surface)
    CHECK(normal(point).cwiseAbs().maxCoeff() == Approx(1));
}

TEST_CASE("Cut cells of a turned box have its volume and its moments") {
  const Vec3 size(3, 2, 1.4);
  const Mat3 rotation =
      Eigen::AngleAxisd(std::numbers::pi / 6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const MaterialGrid grid = voxelize(turned_box(size, rotation), cut(0.15)).grid;
  CHECK(volume(grid) == Approx(size.prod()).epsilon(3e-3));
  CHECK(surface_area(grid) ==
        Approx(2 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0])).epsilon(1e-9));
  Vec3 mean = Vec3::Zero();
  for (std::size_t n = 0; n < grid.cells.size(); ++n)
    mean += grid.fraction_of(n) * grid.center(grid.cells[n]);
  CHECK((mean * std::pow(grid.cell, 3) / volume(grid)).norm() < 0.01);
}

TEST_CASE("Where two parts meet, cells are full and the body has no surface") {
  TriangleMesh mesh;
  add_box(mesh, "left", {0, 0, 0}, {1.3, 2, 2});
  add_box(mesh, "right", {1.3, 0, 0}, {3, 2, 2});
  VoxelizeOptions options = cut(0.25);
  options.materials["left"] = {{.name = "left"}, std::nullopt};
  options.materials["right"] = {{.name = "right"}, std::nullopt};
  const MaterialGrid grid = voxelize(mesh, options).grid;
  CHECK(volume(grid) == Approx(12).epsilon(1e-3));
  CHECK(grid.materials.size() == 2);
  for (const SurfacePoint& point : grid.surface) {
    const Vec3 at = position(grid, point);
    const Vec3 outside = (at - Vec3(1.5, 1, 1)).cwiseAbs() - Vec3(1.5, 1, 1);
    CAPTURE(at.transpose(), normal(point).transpose());
    CHECK(std::abs(outside.maxCoeff()) < 1e-6);
  }
  CHECK(surface_area(grid) == Approx(2 * (3 * 2 + 2 * 2 + 2 * 3)).epsilon(0.02));
}

TEST_CASE("Overlapping parts fill a cell once, and a cavity stays empty") {
  TriangleMesh mesh;
  add_sphere(mesh, "a", {0, 0, 0}, 1, 64);
  add_sphere(mesh, "b", {0.7, 0, 0}, 1, 64);
  const MaterialGrid both = voxelize(mesh, cut(0.1)).grid;
  for (const float fraction : both.fraction) CHECK(fraction <= 1);
  // Two balls of radius 1 whose centres are 0.7 apart.
  const double lens = std::numbers::pi * (4 + 0.7) * std::pow(2 - 0.7, 2) / 12;
  const double ball = 4 * std::numbers::pi / 3;
  CHECK(volume(both) == Approx(2 * ball - lens).epsilon(0.01));

  TriangleMesh shell;
  add_sphere(shell, "shell", {0, 0, 0}, 1, 64);
  add_sphere(shell, "hole", {0, 0, 0}, 0.6, 64);
  turn_inside_out(shell, shell.parts[1]);
  shell.parts[0].triangle_count += shell.parts[1].triangle_count;
  shell.parts.pop_back();
  const MaterialGrid hollow = voxelize(shell, cut(0.1)).grid;
  CHECK(volume(hollow) == Approx(ball * (1 - std::pow(0.6, 3))).epsilon(2e-3));
  for (const SurfacePoint& point : hollow.surface) {
    const Vec3 at = position(hollow, point);
    CHECK(normal(point).dot(at) * (at.norm() > 0.8 ? 1 : -1) > 0);
  }
}

TEST_CASE("Cut cells do not depend on the number of threads") {
  TriangleMesh mesh;
  add_sphere(mesh, "a", {0, 0, 0}, 1);
  add_sphere(mesh, "b", {1.5, 0.1, 0}, 1);
  VoxelizeOptions options = cut(0.1);
  options.threads = 1;
  const MaterialGrid one = voxelize(mesh, options).grid;
  options.threads = 3;
  const MaterialGrid three = voxelize(mesh, options).grid;
  CHECK(one.cells == three.cells);
  CHECK(one.fraction == three.fraction);
  REQUIRE(one.surface.size() == three.surface.size());
  for (std::size_t p = 0; p < one.surface.size(); ++p) {
    CHECK(one.surface[p].place == three.surface[p].place);
    CHECK(one.surface[p].area == three.surface[p].area);
  }
}

TEST_CASE("A sheet thinner than half a cell has about its volume") {
  TriangleMesh mesh;
  add_box(mesh, "sheet", {0, 0, 0.45}, {2, 2, 0.55});
  add_box(mesh, "block", {0, 0, 0}, {2, 2, 0.45});
  const MaterialGrid grid = voxelize(mesh, cut(0.25)).grid;
  CHECK(volume(grid) == Approx(2.2).epsilon(0.04));
}

TEST_CASE(
    "Cut cells whose centres are outside have no depth, and the others that of their centre") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 64);
  MaterialGrid grid = voxelize(mesh, cut(0.15)).grid;
  grid.depth = measure_depth(grid, mesh);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    const double inside = 1 - grid.center(grid.cells[n]).norm();
    CHECK(grid.depth[n] == Approx(std::max(0.0, inside)).margin(0.1 * grid.cell));
  }
}

TEST_CASE("Whole cells are those of which half is inside") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1, 64);
  const MaterialGrid grid = voxelize(mesh, cut(0.1)).grid;
  const MaterialGrid whole = whole_cells(grid);
  CHECK(whole.fraction.empty());
  CHECK(whole.surface.empty());
  CHECK(volume(whole) == Approx(4 * std::numbers::pi / 3).epsilon(0.01));
  CHECK(whole.cells.size() < grid.cells.size());
}

TEST_CASE("Grids with wrong fractions or points of a surface are refused") {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 1);
  const MaterialGrid good = voxelize(mesh, cut(0.3)).grid;
  const auto refused = [&](auto change) {
    MaterialGrid grid = good;
    change(grid);
    CHECK_THROWS_AS(validate(grid), InputError);
  };
  refused([](MaterialGrid& g) { g.fraction.pop_back(); });
  refused([](MaterialGrid& g) { g.fraction[0] = 0; });
  refused([](MaterialGrid& g) { g.fraction[0] = 1.5F; });
  refused([](MaterialGrid& g) { g.surface[0].area = 0; });
  refused([](MaterialGrid& g) { g.surface[0].place[1] = 2; });
  refused([](MaterialGrid& g) { g.surface[0].normal[0] += 0.5F; });
  refused([](MaterialGrid& g) { g.surface[0].cell = {-100, 0, 0}; });
}

}  // namespace springlod::voxelize
