#include "bench/bodies.hpp"

#include <cmath>

#include "lod/build.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::bench {
namespace {

constexpr double kCell = 0.01;  // [m]

}  // namespace

MassSpringModel lattice_cube(int side) {
  voxelize::MaterialGrid grid;
  grid.cell = kCell;
  grid.origin = {0, 0, -0.1 * kCell};
  grid.materials = {Material{.name = "block", .damping = 0.0002}};
  for (int z = 0; z < side; ++z)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) grid.cells.push_back({x, y, z});
  grid.material.assign(grid.cells.size(), 0);
  return voxelize::build_lattice(grid).model;
}

MassSpringModel merged_cube(std::uint32_t nodes) {
  // Standard merging leaves about 43 % of the nodes.
  const auto side = static_cast<int>(std::lround(std::cbrt(nodes / 0.43))) - 1;
  return lod::simplify(lattice_cube(side), {.levels = 1}).levels[1].model;
}

}  // namespace springlod::bench
