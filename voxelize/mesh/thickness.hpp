#pragma once

#include "model/mesh.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

/// The thickness of a solid of that volume [m]: the median over its surface of the distance from a
/// point to the surface on the other side, along the inward normal. Of a plate its thickness, of a
/// rod or a ring of round section the diameter, of a bar its width, of a hollow body its wall. 0
/// without volume, and for a sheet.
double thickness(const TriangleMesh& mesh, const SolidReport& solid, double volume);

}  // namespace springlod::voxelize
