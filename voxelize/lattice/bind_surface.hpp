#pragma once

#include "model/mass_spring.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/lattice/corner_nodes.hpp"

namespace springlod::voxelize {

/// Gives a lattice of `corners` the contact surface of its grid: each point is bound to the eight
/// nodes of its cell, with the weights of trilinear interpolation. The contact areas of the nodes
/// become those of the points, shared by these weights. Nothing for a grid without points.
void bind_surface(const MaterialGrid& grid, const CornerNodes& nodes, MassSpringModel& model);

}  // namespace springlod::voxelize
