#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod {

/// Whether one part bounds a volume.
struct SolidReport {
  std::string part;
  std::uint64_t boundary_edges = 0;     ///< edges with one triangle, after welding by position
  std::uint64_t nonmanifold_edges = 0;  ///< edges with an odd number (> 1) or a bad orientation
  double volume = 0;                    ///< signed [m3]
  Vec3 first_hole = Vec3::Zero();       ///< midpoint of the first boundary edge [m]
  bool closed() const { return boundary_edges == 0; }
};

/// One report a part.
std::vector<SolidReport> check_solid(const TriangleMesh& mesh);

}  // namespace springlod
