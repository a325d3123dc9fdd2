#pragma once

// Bodies of lattice cells: blocks, and the two of docs/paper.md.

#include <cstdint>
#include <utility>
#include <vector>

#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/lattice.hpp"

namespace springlod::test {

/// A cell and the number of its material.
using Cell = std::pair<voxelize::CellIndex, std::uint16_t>;

/// `cells` in any order, of edge length `cell` [m].
voxelize::MaterialGrid grid_of(std::vector<Cell> cells, double cell,
                               std::vector<Material> materials);

/// [Pa], [kg/m3], [s]
Material material(const char* name, double young, double density, double damping);

/// nx x ny x nz cells of edge length `cell` [m].
MassSpringModel block(int nx, int ny, int nz, double cell, const Material& of,
                      voxelize::LatticeStyle style);
/// Cells of 0.1 m, E = 1 MPa, 1000 kg/m3, a damping time of 0.2 ms.
MassSpringModel block(int nx, int ny, int nz,
                      voxelize::LatticeStyle style = voxelize::LatticeStyle::centers);

/// Two stiff rods of 9 cells joined by 5 cells of rubber, 4 x 4 across, along z: 368 nodes, 4748
/// ends.
MassSpringModel rods();

/// The 281 lattice points nearest to (0.04, 0.02, 0.01) a, with a dense core of radius 2.3 a: 3856
/// ends.
MassSpringModel ball();

}  // namespace springlod::test
