#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lod/build.hpp"
#include "model/chain.hpp"
#include "sim/scenario.hpp"
#include "voxelize/lattice.hpp"

/// The test bodies of the spec (section 4) and smaller ones, with the scenes of section 6.
namespace springlod::bodies {

inline voxelize::MaterialGrid grid_of(
    std::vector<std::pair<voxelize::CellIndex, std::uint16_t>> cells, double cell,
    std::vector<Material> materials) {
  std::sort(cells.begin(), cells.end(), [](const auto& p, const auto& q) {
    return std::array{p.first[2], p.first[1], p.first[0]} <
           std::array{q.first[2], q.first[1], q.first[0]};
  });
  voxelize::MaterialGrid grid;
  grid.cell = cell;
  grid.materials = std::move(materials);
  for (const auto& [index, material] : cells) {
    grid.cells.push_back(index);
    grid.material.push_back(material);
    grid.depth.push_back(0);
  }
  return grid;
}

inline Material material(const char* name, double young, double density, double damping) {
  return {.name = name, .young = young, .density = density, .damping = damping, .colour = {}};
}

inline MassSpringModel block(int nx, int ny, int nz, double cell, const Material& of,
                             voxelize::LatticeStyle style) {
  std::vector<std::pair<voxelize::CellIndex, std::uint16_t>> cells;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) cells.push_back({{x, y, z}, 0});
  return voxelize::build_lattice(grid_of(cells, cell, {of}), {.style = style}).model;
}

/// 281 lattice points nearest to (0.04, 0.02, 0.01) a, dense core within 2.3 a of it.
inline MassSpringModel ball() {
  const Vec3 center(0.04, 0.02, 0.01);
  constexpr int kReach = 6;
  std::vector<std::pair<double, voxelize::CellIndex>> near;
  for (int z = -kReach; z <= kReach; ++z)
    for (int y = -kReach; y <= kReach; ++y)
      for (int x = -kReach; x <= kReach; ++x)
        near.push_back({(Vec3(x, y, z) - center).norm(), {x, y, z}});
  std::sort(near.begin(), near.end());
  std::vector<std::pair<voxelize::CellIndex, std::uint16_t>> cells;
  for (std::size_t i = 0; i < 281; ++i)
    cells.push_back({near[i].second, static_cast<std::uint16_t>(near[i].first < 2.3 ? 0 : 1)});
  const auto grid =
      grid_of(cells, 0.1, {material("core", 1e6, 1000, 0.004), material("shell", 1e5, 200, 0.004)});
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::centers}).model;
}

/// Two stiff rods of 9 cells with a joint of 5 between, 4x4 cells across.
inline MassSpringModel rods() {
  std::vector<std::pair<voxelize::CellIndex, std::uint16_t>> cells;
  for (int z = 0; z < 23; ++z)
    for (int y = 0; y < 4; ++y)
      for (int x = 0; x < 4; ++x)
        cells.push_back({{x, y, z}, static_cast<std::uint16_t>(z < 9 || z >= 14 ? 0 : 1)});
  const auto grid = grid_of(
      cells, 0.1, {material("rod", 1e7, 1000, 0.0005), material("joint", 2e5, 1000, 0.0005)});
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::centers}).model;
}

/// Neither gravity nor obstacles.
inline sim::Scenario weightless(double duration) {
  sim::Scenario scene;
  scene.gravity = Vec3::Zero();
  scene.duration = duration;
  return scene;
}

inline sim::Obstacle floor(double kappa, double friction) {
  sim::Obstacle obstacle;
  obstacle.shape = sim::Plane{Vec3::UnitZ(), 0};
  obstacle.name = "floor";
  obstacle.stiffness = kappa;
  obstacle.friction = friction;
  return obstacle;
}

/// A small block and two levels of it.
inline const LodChain& small_chain() {
  static const LodChain chain = lod::simplify(
      block(5, 4, 3, 0.1, material("m", 1e6, 1000, 0.002), voxelize::LatticeStyle::centers), {});
  return chain;
}

/// For small_chain: thrown turning onto the floor.
inline sim::Scenario small_scene(double duration) {
  sim::Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.5};
  scene.start.velocity = {2, 0, 0};
  scene.start.spin = {0, 3, 1};
  scene.duration = duration;
  return scene;
}

/// Scene 1: the ball thrown along a floor.
inline sim::Scenario ball_scene() {
  sim::Scenario scene;
  scene.obstacles = {floor(1e6, 0.5)};
  scene.start.placed = true;
  scene.start.position = {0, 0, 0.6};
  scene.start.velocity = {3.2, 0, 0};
  scene.stop = sim::StopRule{0.1, 0.25};
  scene.duration = 12;
  return scene;
}

/// Scene 2: the rods thrown turning at a wall.
inline sim::Scenario rods_scene() {
  sim::Scenario scene;
  sim::Obstacle wall = floor(2e6, 0.5);
  wall.shape = sim::Plane{-Vec3::UnitX(), -2};
  wall.name = "wall";
  scene.obstacles = {floor(2e6, 0.5), wall};
  scene.start.placed = true;
  scene.start.position = {0, 0, 2};
  scene.start.velocity = {10, 0, 0};
  scene.start.spin = {0, 6, 0};
  scene.duration = 5;
  scene.measure_from = "wall";
  return scene;
}

}  // namespace springlod::bodies
