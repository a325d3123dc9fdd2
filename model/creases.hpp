#pragma once

#include <vector>

#include "model/mesh.hpp"

namespace springlod {

/// A mesh as a picture wants it: a vertex on a crease is there once a side, each with the normal of
/// its side. Triangles correspond one to one to those of the mesh.
struct ShadedMesh {
  std::vector<std::uint32_t> vertex;  ///< which vertex of the mesh each one is, V'
  std::vector<Vec3> normals;          ///< unit length, V'
  std::vector<Triangle> triangles;    ///< indices into V'
};

/// Normals are area-weighted means over the triangles around a vertex that lie within
/// `crease_degrees` of the triangle at hand; up where all of these have no area.
ShadedMesh split_at_creases(const TriangleMesh& mesh, double crease_degrees = 40);

}  // namespace springlod
