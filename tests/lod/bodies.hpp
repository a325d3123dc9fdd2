#pragma once

// The test bodies of the paper's scenes on the `centers` lattice, cell 0.1 m.

#include <algorithm>
#include <array>
#include <vector>

#include "voxelize/lattice.hpp"

namespace springlod::test {

inline const double kCell = 0.1;

inline voxelize::MaterialGrid block_grid(int nx, int ny, int nz) {
  voxelize::MaterialGrid grid;
  grid.cell = kCell;
  grid.materials = {Material{.name = "block"}};
  for (int z = 0; z < nz; ++z)
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x) {
        grid.cells.push_back({x, y, z});
        grid.material.push_back(0);
        grid.depth.push_back(0);
      }
  return grid;
}

inline MassSpringModel block(int nx, int ny, int nz,
                             voxelize::LatticeStyle style = voxelize::LatticeStyle::centers) {
  return voxelize::build_lattice(block_grid(nx, ny, nz), {.style = style}).model;
}

/// Two stiff rods of 9 cells joined by 5 cells of rubber, 4 x 4 across: 368 nodes, 4748 ends.
inline MassSpringModel rods() {
  voxelize::MaterialGrid grid = block_grid(4, 4, 23);
  grid.materials = {Material{.name = "rod", .young = 1e7, .damping = 0.0005},
                    Material{.name = "rubber", .young = 2e5, .damping = 0.0005}};
  for (std::size_t c = 0; c < grid.cells.size(); ++c)
    grid.material[c] = grid.cells[c][2] >= 9 && grid.cells[c][2] < 14 ? 1 : 0;
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::centers}).model;
}

/// The 281 lattice points nearest to (0.04, 0.02, 0.01) a, dense core within 2.3 a: 3856 ends.
inline MassSpringModel ball() {
  const Vec3 center(0.04, 0.02, 0.01);
  struct Point {
    double distance;
    voxelize::CellIndex cell;
  };
  std::vector<Point> points;
  for (int z = -6; z <= 6; ++z)
    for (int y = -6; y <= 6; ++y)
      for (int x = -6; x <= 6; ++x) points.push_back({(Vec3(x, y, z) - center).norm(), {x, y, z}});
  std::sort(points.begin(), points.end(),
            [](const Point& p, const Point& q) { return p.distance < q.distance; });
  points.resize(281);
  std::sort(points.begin(), points.end(), [](const Point& p, const Point& q) {
    return std::array{p.cell[2], p.cell[1], p.cell[0]} <
           std::array{q.cell[2], q.cell[1], q.cell[0]};
  });
  voxelize::MaterialGrid grid;
  grid.cell = kCell;
  grid.materials = {Material{.name = "core", .young = 1e6, .density = 1000, .damping = 0.004},
                    Material{.name = "shell", .young = 1e5, .density = 200, .damping = 0.004}};
  for (const Point& p : points) {
    grid.cells.push_back(p.cell);
    grid.material.push_back(p.distance <= 2.3 ? 0 : 1);
    grid.depth.push_back(0);
  }
  return voxelize::build_lattice(grid, {.style = voxelize::LatticeStyle::centers}).model;
}

}  // namespace springlod::test
