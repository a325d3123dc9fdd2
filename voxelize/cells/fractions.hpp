#pragma once

#include <vector>

#include "voxelize/cells/frame.hpp"
#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// Fraction of the unit cube about the origin where normal . x <= -distance [1]: the part below a
/// plane at a signed distance from the centre, negative if the centre is inside. `normal` must not
/// be 0; `distance` is in units of its length (Scardovelli & Zaleski 2000, "Analytical relations
/// connecting linear interfaces and volume fractions in rectangular grids").
double cut_cube(const Vec3& normal, double distance);

/// The frame whose cells are the eighths of those of `frame`.
CellFrame halved(const CellFrame& frame);

/// Adds to each cell of the frame the fraction of it that is inside one solid. `halves` is the
/// solid's level set in the cells of halved(frame), each cut by a plane of its own: curved surfaces
/// are exact to second order, edges within an eighth of a cell. Returns the volume added [cells].
double add_fractions(const DistanceField& halves, const CellFrame& frame,
                     std::vector<float>& fraction);

}  // namespace springlod::voxelize
