#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::report {

/// Triangles between some of the vertices of a mesh.
struct CoarseSurface {
  std::vector<std::uint32_t> vertex;  ///< number in the mesh of each vertex that is kept
  std::vector<std::uint32_t> part;    ///< number of the mesh part of each
  std::vector<Triangle> triangles;    ///< of indices into `vertex`
};

/// A mesh with at most `most` triangles, by vertex clustering (Rossignac and Borrel 1993): of the
/// vertices of a part in one cell of a grid, the one next to their mean is kept, and triangles
/// without three different cells vanish. A mesh that is small enough keeps all its triangles. For
/// pictures: thin features may vanish, and the result need not be closed.
CoarseSurface coarse_surface(const TriangleMesh& mesh, std::uint32_t most);

}  // namespace springlod::report
