#pragma once

#include "tests/voxelize/shapes.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::test {

/// The cut cells of a ball of diameter 1 m, off the grid by fractions of a cell. E = 1 MPa, 1000
/// kg/m3.
inline voxelize::MaterialGrid cut_ball_grid(double cells_across, double poisson = 0.25) {
  TriangleMesh mesh;
  add_sphere(mesh, "ball", {0, 0, 0}, 0.5, 64);
  voxelize::VoxelizeOptions options;
  options.cell = 1 / cells_across;
  options.cut_cells = true;
  options.fallback = {{.name = "body", .young = 1e6, .density = 1000, .damping = 0.0002},
                      std::nullopt};
  options.fallback.material.poisson = poisson;
  return voxelize::voxelize(mesh, options).grid;
}

inline MassSpringModel cut_ball(double cells_across, double poisson = 0.25) {
  return voxelize::build_lattice(cut_ball_grid(cells_across, poisson)).model;
}

}  // namespace springlod::test
