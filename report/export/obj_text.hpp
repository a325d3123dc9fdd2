#pragma once

#include <string>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::report {

/// The surface as OBJ with its vertices at `points` [m], an object for each mesh part. The vertices
/// keep their order. `origin`: one line for a comment.
std::string obj_text(const TriangleMesh& surface, const std::vector<Vec3>& points,
                     const std::string& origin);

}  // namespace springlod::report
