#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod {

/// One solid and whether it bounds a volume. Parts of one name are one solid (an object with two
/// materials comes as two open parts); so are open parts whose boundaries meet (a file that names
/// the lid and the pot apart).
struct SolidReport {
  std::string part;                     ///< name of its first part
  std::vector<std::uint32_t> parts;     ///< numbers of its parts in the mesh, rising
  std::uint64_t boundary_edges = 0;     ///< edges with one triangle, after welding by position
  std::uint64_t nonmanifold_edges = 0;  ///< edges with an odd number (> 1) or a bad orientation
  double volume = 0;                    ///< signed [m3]
  Vec3 first_hole = Vec3::Zero();       ///< midpoint of the first boundary edge [m]
  bool closed() const { return boundary_edges == 0; }
};

/// One report a solid, in the order of their first parts. Vertices nearer than 1e-6 of the
/// diagonal of the bounding box are one (files in single precision round).
std::vector<SolidReport> check_solid(const TriangleMesh& mesh);

/// For each vertex the lowest vertex that it is welded to.
std::vector<std::uint32_t> weld_vertices(const TriangleMesh& mesh);

}  // namespace springlod
