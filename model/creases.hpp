#pragma once

#include <cstdint>
#include <vector>

#include "model/mesh.hpp"

namespace springlod::inline model {

/// A surface as it is drawn: mesh vertices are split where the rest mesh has a crease or the part
/// changes, so that rims stay crisp and the rest is smooth. Made once; positions then move.
struct SplitSurface {
  std::vector<std::uint32_t> source;  ///< drawn vertex -> mesh vertex
  std::vector<std::uint32_t> part;    ///< drawn vertex -> part
  std::vector<Triangle> triangles;    ///< of drawn vertices
  /// Angle of each corner at rest [rad]: the weight of its triangle's normal. Taken once: a
  /// deformation that changes it much has worse trouble than its shading.
  std::vector<std::array<float, 3>> corner_angle;
  /// Every edge has two triangles and every part faces outwards: back faces need not be drawn.
  bool closed = false;
};

/// Edges bent by more than this stay sharp: above the facets of a coarse cylinder (30 deg for 12
/// sides), below any rim that is meant.
constexpr double kCreaseDegrees = 40;

SplitSurface split_at_creases(const TriangleMesh& mesh, double crease_degrees = kCreaseDegrees);

/// Unit normals of the drawn vertices for `positions` of the mesh vertices; zero where all
/// triangles are degenerate.
std::vector<Eigen::Vector3f> vertex_normals(const SplitSurface& surface,
                                            const std::vector<Vec3>& positions);

}  // namespace springlod::inline model
