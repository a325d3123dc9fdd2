#pragma once

#include <vector>

#include "model/corners.hpp"
#include "model/mass_spring.hpp"

namespace springlod::voxelize {

/// Corners for a model with springs in any directions, eight octants around each node. For each
/// octant, the corner is the triple of spring neighbours whose cone contains the octant's diagonal
/// and whose corner_shape is the largest, among the triples that springs join with one another. An
/// octant without such a triple, as outside the surface, has no corner. Corners with the same four
/// nodes are kept once, at their lowest apex. E is the harmonic mean of those of the four nodes'
/// materials, as for the springs (docs/method.md, section 2).
std::vector<Corner> choose_corners(const MassSpringModel& model);

}  // namespace springlod::voxelize
