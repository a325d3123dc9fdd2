#pragma once

#include <cstdint>
#include <vector>

#include "model/creases.hpp"
#include "render/scene.hpp"

namespace springlod::render {

// Input of the graphics pipeline: single-precision records, positions relative to an origin [m].

struct SurfaceVertex {
  Eigen::Vector3f position;
  Eigen::Vector3f normal;
  Colour colour;
  float inside;  // distance from the cut at rest [m], below 0: cut away
};
struct SpringInstance {
  Eigen::Vector3f a, b;
  Colour colour_a, colour_b;
  float radius;
};
struct NodeInstance {
  Eigen::Vector3f center;
  Colour colour;
  float radius;
};

/// True if the cut of the style hides the node.
bool is_cut_away(const DrawnBody& body, std::uint32_t node);

/// Colour of a part of the surface.
Colour part_colour(const DrawnBody& body, std::uint32_t part);

std::vector<SurfaceVertex> surface_vertices(const DrawnBody& body, const SplitSurface& surface,
                                            const Vec3& origin);
std::vector<SpringInstance> spring_instances(const DrawnBody& body, const Vec3& origin);
std::vector<NodeInstance> node_instances(const DrawnBody& body, const Vec3& origin);

/// A box as a mesh, which is drawn and casts shadows like any surface.
TriangleMesh box_mesh(const DrawnBox& box);

/// The twelve edges of a box as thin rods.
std::vector<SpringInstance> box_edges(const DrawnBox& box, const Vec3& origin, const Colour& colour,
                                      float radius);

/// Points whose convex hull contains everything drawn of a body, balls with their radius included.
/// For framing a camera.
std::vector<Vec3> outline(const DrawnBody& body);

/// Bounding box of everything drawn of a body.
Box3 drawn_bounds(const DrawnBody& body);

/// Throws InputError for wrong counts and positions that are not finite.
void validate(const DrawnBody& body);

}  // namespace springlod::render
