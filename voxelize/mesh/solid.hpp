#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::voxelize {

/// A solid, and whether it encloses a volume. Parts of one name form one solid (an object with two
/// materials has two open parts); so do open parts with a common boundary (a file with separate
/// names for the lid and the pot).
struct SolidReport {
  std::string part;                     ///< name of its first mesh part
  std::vector<std::uint32_t> parts;     ///< numbers of its mesh parts, ascending
  std::uint64_t boundary_edges = 0;     ///< edges with one triangle, after welding
  std::uint64_t nonmanifold_edges = 0;  ///< with an odd number (> 1) or inconsistent orientation
  double volume = 0;                    ///< signed [m3]
  Vec3 first_hole = Vec3::Zero();       ///< midpoint of the first boundary edge [m]
  bool closed() const { return boundary_edges == 0; }
  bool faultless() const { return closed() && nonmanifold_edges == 0 && volume >= 0; }
};

/// One report for each solid, in the order of their first parts. Throws InputError as validate()
/// does.
std::vector<SolidReport> check_solid(const TriangleMesh& mesh);
/// The same for a valid mesh; `welded` is weld_vertices(mesh).
std::vector<SolidReport> check_solid(const TriangleMesh& mesh,
                                     const std::vector<std::uint32_t>& welded);

}  // namespace springlod::voxelize
