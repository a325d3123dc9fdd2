#pragma once

#include <vector>

#include "model/mesh.hpp"
#include "voxelize/cells/frame.hpp"
#include "voxelize/mesh/winding.hpp"

namespace springlod::voxelize {

/// The cells of the frame, in grid order, at whose centre the winding number of the surface is
/// above 1/2: the inside of a closed surface, or of one whose holes are closed by a skin.
/// `positions` and `surface` are in cells (CellFrame::to_index).
std::vector<CellIndex> wound_cells(const WindingNumber& surface, const std::vector<Vec3>& positions,
                                   const std::vector<Triangle>& triangles, const CellFrame& frame);

}  // namespace springlod::voxelize
