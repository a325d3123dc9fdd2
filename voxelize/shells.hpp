#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/solid.hpp"

namespace springlod::voxelize {

/// The connected surfaces of one solid, sorted by what they do.
struct Shells {
  std::vector<Triangle> outer;   ///< all that enclose material
  std::vector<Triangle> cavity;  ///< all that enclose a hollow inside the outer ones
  double volume = 0;             ///< outer less cavities [m3] >= 0
  bool turned = false;           ///< a shell was inside out and not taken for a cavity
};

/// Those of each solid. A shell that faces inwards while the solid as a whole faces outwards is a
/// cavity if its bounding box lies in that of an outer shell, and else an outer shell the wrong way
/// round. `welded` is weld_vertices(mesh).
std::vector<Shells> sort_shells(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                                const std::vector<std::uint32_t>& welded);

}  // namespace springlod::voxelize
