#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::voxelize {

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

/// One report a solid, in the order of their first parts. Throws InputError as validate() does.
std::vector<SolidReport> check_solid(const TriangleMesh& mesh);
/// The same of a valid mesh; `welded` is weld_vertices(mesh).
std::vector<SolidReport> check_solid(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& welded);

}  // namespace springlod::voxelize
