#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/frame.hpp"

namespace springlod {

/// Level set of the volume enclosed by the triangles, which must be closed (OpenVDB meshToVolume:
/// orientation does not matter, what lies within another shell is filled).
std::shared_ptr<DistanceField> level_set(const std::vector<Vec3>& positions,
                                         const std::vector<Triangle>& triangles,
                                         const CellFrame& frame);

/// All of `a` and `b`, and `a` without `b`; both are used up, `a` becomes the result.
void unite(DistanceField& a, DistanceField& b);
void subtract(DistanceField& a, DistanceField& b);

/// Numbers of the cells whose centre is inside or on the surface, each once.
std::vector<std::uint32_t> inside_cells(const DistanceField& field, const CellFrame& frame);

}  // namespace springlod
