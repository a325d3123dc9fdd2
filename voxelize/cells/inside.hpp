#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/cells/frame.hpp"

namespace springlod::voxelize {

/// Level set of the volume enclosed by closed surfaces (OpenVDB meshToVolume: orientation does not
/// matter, and shells inside others are filled). `positions` are in cells (CellFrame::to_index).
std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame);

/// The same with the inside given by a function of a cell, which is called by several threads:
/// for surfaces that cross, or enclose cavities.
std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame,
                                         const std::function<bool(const CellIndex&)>& inside);

/// Level set of some cells of the frame.
std::shared_ptr<DistanceField> level_set(const std::vector<CellIndex>& cells,
                                         const CellFrame& frame);

/// Union of `a` and `b`. The result is in `a`; `b` is consumed.
void unite(DistanceField& a, DistanceField& b);

/// Assigns the cells whose centre is inside or on the surface to `claimant`, unless they have an
/// owner already. `owner` has one number for each cell of the frame, 0 for none. Returns the number
/// of cells inside, whoever owns them.
std::size_t claim_cells(const DistanceField& field, const CellFrame& frame, std::uint16_t claimant,
                        std::vector<std::uint16_t>& owner);

/// The number of cells whose centre is inside or on the surface.
std::size_t count_cells(const DistanceField& field, const CellFrame& frame);
/// These cells, in grid order.
std::vector<CellIndex> cells_inside(const DistanceField& field, const CellFrame& frame);

/// Distance of the centre of a cell from the surface [m], negative inside, at most that of the
/// band of three cells.
double distance_at(const DistanceField& field, const CellIndex& cell);
/// The same at any place, in cells (CellFrame::to_index), interpolated between the centres.
double distance_at(const DistanceField& field, const Vec3& place);

}  // namespace springlod::voxelize
