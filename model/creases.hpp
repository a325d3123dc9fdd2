#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::inline model {

/// A surface split for smooth shading: mesh vertices are duplicated along creases of the rest mesh
/// and between parts. Made once; positions then move.
struct SplitSurface {
  std::vector<std::uint32_t> source;  ///< drawn vertex -> mesh vertex
  std::vector<std::uint32_t> part;    ///< drawn vertex -> mesh part
  std::vector<Triangle> triangles;    ///< of drawn vertices
  /// Angle of each corner at rest [rad]: the weight of its triangle's normal. It is not updated
  /// when the surface deforms.
  std::vector<std::array<float, 3>> corner_angle;
  /// Every edge has two triangles and every part faces outwards: back faces need no drawing.
  bool closed = false;
};

/// Edges with a larger angle between their faces are creases [deg]. A coarse cylinder of 12 sides
/// has 30 deg; intended rims have more than 40.
constexpr double kCreaseDegrees = 40;

SplitSurface split_at_creases(const TriangleMesh& mesh, double crease_degrees = kCreaseDegrees);

/// Unit normals of the drawn vertices for `positions` of the mesh vertices; zero where all
/// triangles are degenerate.
std::vector<Eigen::Vector3f> vertex_normals(const SplitSurface& surface,
                                            const std::vector<Vec3>& positions);

}  // namespace springlod::inline model
