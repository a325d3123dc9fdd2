#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/frame.hpp"

namespace springlod::voxelize {

/// Level set of the volume enclosed by the triangles, which must be closed (OpenVDB meshToVolume:
/// orientation does not matter, what lies within another shell is filled). `positions` are in cells
/// (CellFrame::to_index).
std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame);

/// All of `a` and `b`, and `a` without `b`; both are used up, `a` becomes the result.
void unite(DistanceField& a, DistanceField& b);
void subtract(DistanceField& a, DistanceField& b);

/// Gives the cells whose centre is inside or on the surface to `claimant`, unless they belong to
/// another already. `owner` has one number for each cell of the frame, 0 for cells of nobody.
/// Returns how many cells are inside, whosever they are.
std::size_t claim_cells(const DistanceField& field, const CellFrame& frame, std::uint16_t claimant,
                        std::vector<std::uint16_t>& owner);

}  // namespace springlod::voxelize
