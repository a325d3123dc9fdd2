#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

/// The connected surfaces of one solid, by kind.
struct Shells {
  std::vector<Triangle> outer;   ///< of the shells that enclose material
  std::vector<Triangle> cavity;  ///< of the shells that enclose a cavity
  std::size_t count = 0;         ///< of both kinds
  double volume = 0;             ///< outer shells minus cavities [m3] >= 0
  bool turned = false;           ///< an outer shell faced inwards
};

/// The shells of each solid. A shell that faces inwards while the solid as a whole faces outwards
/// is a cavity if it begins inside the other shells; otherwise it is an outer shell with the wrong
/// orientation. In a closed solid, the triangles of outer shells are turned outwards, those of
/// cavities inwards. `welded` is weld_vertices(mesh).
std::vector<Shells> sort_shells(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                                const std::vector<std::uint32_t>& welded);

}  // namespace springlod::voxelize
