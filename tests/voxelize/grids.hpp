#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::test {

/// A grid of the given cells, in any order, each with material 0 of two (soft, stiff).
inline voxelize::MaterialGrid grid_of(std::vector<voxelize::CellIndex> cells, double cell = 1) {
  std::sort(cells.begin(), cells.end(),
            [](const voxelize::CellIndex& l, const voxelize::CellIndex& r) {
              return std::tie(l[2], l[1], l[0]) < std::tie(r[2], r[1], r[0]);
            });
  voxelize::MaterialGrid grid;
  grid.cell = cell;
  grid.material.assign(cells.size(), 0);
  grid.depth.assign(cells.size(), 0.25F);
  grid.cells = std::move(cells);
  grid.materials = {{.name = "soft", .young = 1e6, .density = 1000, .damping = 0.002},
                    {.name = "stiff", .young = 4e6, .density = 2500, .damping = 0.0005}};
  return grid;
}

inline voxelize::MaterialGrid box_grid(std::int32_t nx, std::int32_t ny, std::int32_t nz,
                                       double cell = 1) {
  std::vector<voxelize::CellIndex> cells;
  for (std::int32_t z = 0; z < nz; ++z)
    for (std::int32_t y = 0; y < ny; ++y)
      for (std::int32_t x = 0; x < nx; ++x) cells.push_back({x, y, z});
  return grid_of(std::move(cells), cell);
}

}  // namespace springlod::test
