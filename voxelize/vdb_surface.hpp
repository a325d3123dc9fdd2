#pragma once

// Includes OpenVDB: for vdb_file.cpp only.
#include <openvdb/openvdb.h>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// The points of a grid's surface, with the attributes "N" and "area". `transform`: the grid's.
openvdb::GridBase::Ptr vdb_of_surface(const MaterialGrid& grid,
                                      const openvdb::math::Transform& transform);

/// The points that vdb_of_surface wrote, for a grid that has its cells. Throws InputError if they
/// are of another kind, or outside the cells.
std::vector<SurfacePoint> surface_of_vdb(const openvdb::GridBase& points, const MaterialGrid& grid);

}  // namespace springlod::voxelize
