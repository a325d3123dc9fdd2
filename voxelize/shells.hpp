#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/solid.hpp"

namespace springlod::voxelize {

/// The connected surfaces of one solid, by kind.
struct Shells {
  std::vector<Triangle> outer;   ///< of the shells that enclose material
  std::vector<Triangle> cavity;  ///< of the shells that enclose a cavity
  double volume = 0;             ///< outer shells minus cavities [m3] >= 0
  bool turned = false;           ///< an outer shell faced inwards
};

/// The shells of each solid. A shell that faces inwards while the solid as a whole faces outwards
/// is a cavity if its bounding box lies in that of an outer shell; otherwise it is an outer shell
/// with the wrong orientation. `welded` is weld_vertices(mesh).
std::vector<Shells> sort_shells(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                                const std::vector<std::uint32_t>& welded);

}  // namespace springlod::voxelize
