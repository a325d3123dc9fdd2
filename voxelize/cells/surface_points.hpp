#pragma once

#include <optional>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/grid.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {

/// Points of the outer surface of a voxelized mesh, whose areas add up to its area: for each half
/// cell that the surface passes, and each of the six directions that it faces there, the mean of
/// its pieces. They are about four for each cell of the surface; fewer are noisy under a round
/// contact, more are no better. Surfaces between two parts, and points farther than a cell from
/// every filled one, are left out. `grid` needs its distance field.
/// The points are in the order of sort_points.
std::vector<SurfacePoint> surface_points(const MaterialGrid& grid, const TriangleMesh& mesh);

/// A point without normal and area at a place in units of cells (cell (0, 0, 0) reaches from 0 to
/// 1), in the filled cell there or in the nearest of those next to it; none if there is none.
std::optional<SurfacePoint> point_in_cells(const IndexLookup& filled, const Vec3& at);

/// Sorts points by cell (z, y, x), then by place and normal.
void sort_points(std::vector<SurfacePoint>& points);

}  // namespace springlod::voxelize
