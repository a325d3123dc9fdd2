#pragma once

#include "model/material.hpp"

namespace springlod::voxelize {

/// Stiffness of a spring of the cubic lattice of 6 + 12 neighbours with one constant [N/m]: E = 2.5
/// k / a (docs/method.md, eq. 1). `cell`: its edge a [m].
inline double cell_stiffness(const Material& material, double cell) {
  constexpr double kYoungPerStiffness = 2.5;
  return spring_young(material) * cell / kYoungPerStiffness;
}

/// Stiffness of a layer of the lattice, one cell thick, that is pressed over an area [m2] and not
/// allowed to spread [N/m]: each node has one spring along the normal and four at 45 degrees.
inline double layer_stiffness(const Material& material, double area, double cell) {
  constexpr double kPerSpring = 3;
  return kPerSpring * cell_stiffness(material, cell) * area / (cell * cell);
}

}  // namespace springlod::voxelize
