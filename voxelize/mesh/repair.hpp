#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/mesh.hpp"
#include "voxelize/mesh/solid.hpp"

namespace springlod::voxelize {

/// What repair() found and mended in one solid. All counts are 0 for a faultless one.
struct SolidRepair {
  std::string part;                  ///< name of its first mesh part
  std::uint64_t doubled = 0;         ///< triangles removed: another one has the same corners
  std::uint64_t turned = 0;          ///< triangles that faced against those around them, turned
  bool without_area = false;         ///< all of its triangles were removed: they have no area
  bool inside_out = false;           ///< all of it faced inwards and was turned
  std::uint64_t open_edges = 0;      ///< edges with one triangle
  std::uint64_t holes = 0;           ///< connected groups of them
  double hole_area = 0;              ///< of the holes [m2]
  double thickness = 0;              ///< of find_faults(): thickness() [m]
  double volume = 0;                 ///< with each hole closed by a fan [m3]
  std::uint64_t crossing_edges = 0;  ///< edges with more than two triangles
};

struct RepairedMesh {
  TriangleMesh mesh;                ///< the same vertices and parts
  std::vector<SolidRepair> solids;  ///< in the order of `solids`
};

/// In each solid that is not faultless(): removes doubled triangles and turns triangles
/// so that connected ones face one way: that of most of their area, or outwards if the solid as a
/// whole faces inwards. Holes stay open (see WindingNumber) and are measured: the area of a hole is
/// that of the smallest plane figure with its vector area. `solids` and `welded` are those of
/// check_solid and weld_vertices.
RepairedMesh repair(const TriangleMesh& mesh, const std::vector<SolidReport>& solids,
                    const std::vector<std::uint32_t>& welded);

/// What repair() would find.
std::vector<SolidRepair> find_faults(const TriangleMesh& mesh);

/// One line for each kind of fault, such as: part "lid": 3 holes (12 open edges, 0.4 cm2) closed.
std::vector<std::string> describe(const SolidRepair& repair);

}  // namespace springlod::voxelize
