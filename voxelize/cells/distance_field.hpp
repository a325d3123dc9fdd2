#pragma once

// Includes OpenVDB: for inside.cpp, fractions.cpp and vdb_file.cpp only.
#include <openvdb/Grid.h>

namespace springlod::voxelize {

/// A level set [m], negative inside; its index (i, j, k) is the centre of cell (i, j, k).
class DistanceField {
 public:
  explicit DistanceField(openvdb::FloatGrid::Ptr level_set) : grid(std::move(level_set)) {}
  openvdb::FloatGrid::Ptr grid;
};

/// Registers OpenVDB's types once. Call it before any other function of OpenVDB.
void start_openvdb();

}  // namespace springlod::voxelize
