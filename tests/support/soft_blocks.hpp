#pragma once

#include "tests/support/bodies.hpp"

namespace springlod::test {

inline Material soft_material(double poisson, double damping = 0.0002) {
  Material of = material("soft", 1e6, 1000, damping);
  of.poisson = poisson;
  return of;
}

/// A block of cells of 0.1 m of one material, E = 1 MPa.
inline MassSpringModel soft_block(int nx, int ny, int nz, double poisson,
                                  voxelize::LatticeStyle style = voxelize::LatticeStyle::corners) {
  return block(nx, ny, nz, 0.1, soft_material(poisson), style);
}

}  // namespace springlod::test
