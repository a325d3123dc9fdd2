#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "model/vec.hpp"

namespace springlod::inline model {

using Triangle = std::array<std::uint32_t, 3>;

/// A mesh part: the consecutive triangles of one named object and material of the file.
struct MeshPart {
  std::string name;      ///< object name in the file; "part_3" if it had none
  std::string material;  ///< material name in the file; may be empty
  std::uint32_t first_triangle = 0;
  std::uint32_t triangle_count = 0;
};

/// Triangles in metres, z up, counter-clockwise seen from outside. The parts cover all triangles in
/// order, without overlap.
struct TriangleMesh {
  std::vector<Vec3> positions;      ///< [m]
  std::vector<Triangle> triangles;  ///< indices into positions
  std::vector<MeshPart> parts;
};

Box3 bounds(const TriangleMesh& mesh);
/// Volume enclosed by one part, by the divergence theorem [m3]; negative if it faces inwards.
double signed_volume(const TriangleMesh& mesh, const MeshPart& part);
double surface_area(const TriangleMesh& mesh);                        ///< [m2]
double surface_area(const TriangleMesh& mesh, const MeshPart& part);  ///< [m2]

/// Throws InputError for an index out of range, a coordinate that is not finite, and parts that do
/// not cover the triangles.
void validate(const TriangleMesh& mesh);

}  // namespace springlod::inline model
