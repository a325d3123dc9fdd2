#include "tests/support/bodies.hpp"

#include <algorithm>
#include <array>

namespace springlod::test {
namespace {

constexpr double kCell = 0.1;  // [m]

bool before(const voxelize::CellIndex& p, const voxelize::CellIndex& q) {
  return std::array{p[2], p[1], p[0]} < std::array{q[2], q[1], q[0]};
}

std::vector<Cell> box_cells(int nx, int ny, int nz) {
  std::vector<Cell> cells;
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) cells.push_back({{x, y, z}, 0});
  return cells;
}

MassSpringModel centers_lattice(const voxelize::MaterialGrid& grid) {
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::centers}).model;
}

}  // namespace

voxelize::MaterialGrid grid_of(std::vector<Cell> cells, double cell,
                               std::vector<Material> materials) {
  std::sort(cells.begin(), cells.end(),
            [](const Cell& p, const Cell& q) { return before(p.first, q.first); });
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

Material material(const char* name, double young, double density, double damping) {
  return {.name = name, .young = young, .density = density, .damping = damping, .colour = {}};
}

MassSpringModel block(int nx, int ny, int nz, double cell, const Material& of,
                      voxelize::LatticeStyle style) {
  return voxelize::build_lattice(grid_of(box_cells(nx, ny, nz), cell, {of}), {.style = style})
      .model;
}

MassSpringModel block(int nx, int ny, int nz, voxelize::LatticeStyle style) {
  return block(nx, ny, nz, kCell, Material{.name = "block", .damping = 0.0002}, style);
}

MassSpringModel rods() {
  std::vector<Cell> cells = box_cells(4, 4, 23);
  for (auto& [index, material] : cells) material = index[2] >= 9 && index[2] < 14 ? 1 : 0;
  return centers_lattice(grid_of(
      cells, kCell, {material("rod", 1e7, 1000, 0.0005), material("rubber", 2e5, 1000, 0.0005)}));
}

MassSpringModel ball() {
  constexpr std::size_t kNodes = 281;
  constexpr int kReach = 6;
  constexpr double kCore = 2.3;
  const Vec3 center(0.04, 0.02, 0.01);
  std::vector<std::pair<double, voxelize::CellIndex>> near;
  for (int z = -kReach; z <= kReach; ++z)
    for (int y = -kReach; y <= kReach; ++y)
      for (int x = -kReach; x <= kReach; ++x)
        near.emplace_back((Vec3(x, y, z) - center).norm(), voxelize::CellIndex{x, y, z});
  std::sort(near.begin(), near.end());
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < kNodes; ++i)
    cells.emplace_back(near[i].second, static_cast<std::uint16_t>(near[i].first < kCore ? 0 : 1));
  return centers_lattice(grid_of(
      cells, kCell, {material("core", 1e6, 1000, 0.004), material("shell", 1e5, 200, 0.004)}));
}

}  // namespace springlod::test
