#pragma once

#include <vector>

#include "render/scene.hpp"

namespace springlod::render {

/// Distance of each surface vertex at rest from the cut of its body [m], below 0: cut away. All 1
/// without a cut.
std::vector<float> kept_distances(const DrawnBody& body);

/// The plane of the cut face where the body is now, relative to `origin`: normal out of the body,
/// offset. Exact for affine motion: the affine map that fits the vertices best moves the plane.
Eigen::Vector4f cut_face(const DrawnBody& body, const Vec3& origin);

/// Triangles of one part, and its colour.
struct CutPart {
  std::size_t first_triangle = 0;
  std::size_t triangle_count = 0;
  Colour colour;
};
/// The parts of a body's surface, largest first: of nested parts the inner one comes last.
std::vector<CutPart> parts_by_size(const DrawnBody& body);

}  // namespace springlod::render
