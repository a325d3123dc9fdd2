#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::voxelize {

/// For each vertex the lowest vertex that it is merged with. Vertices closer than 1e-6 of the
/// diagonal of the bounding box are merged (files in single precision round).
std::vector<std::uint32_t> weld_vertices(const TriangleMesh& mesh);

}  // namespace springlod::voxelize
