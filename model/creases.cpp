#include "model/creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "base/disjoint_sets.hpp"

namespace springlod::inline model {
namespace {

// A corner is vertex `corner % 3` of triangle `corner / 3`.
using Corner = std::uint32_t;

std::vector<std::uint32_t> part_of_triangle(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> part(mesh.triangles.size(), 0);
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p)
    std::fill_n(part.begin() + mesh.parts[p].first_triangle, mesh.parts[p].triangle_count, p);
  return part;
}

std::vector<Vec3> unit_normals(const TriangleMesh& mesh) {
  std::vector<Vec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const Vec3& o = mesh.positions[t[0]];
    normals.push_back(
        (mesh.positions[t[1]] - o).cross(mesh.positions[t[2]] - o).stableNormalized());
  }
  return normals;
}

struct Edge {
  std::uint32_t low, high;  // vertices
  std::uint32_t triangle;
  Corner at_low, at_high;
  bool rising;  // the triangle runs from low to high
  bool operator<(const Edge& e) const {
    return std::tie(low, high, triangle) < std::tie(e.low, e.high, e.triangle);
  }
};

std::vector<Edge> sorted_edges(const TriangleMesh& mesh) {
  std::vector<Edge> edges;
  edges.reserve(mesh.triangles.size() * 3);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      Edge e{mesh.triangles[t][k],
             mesh.triangles[t][(k + 1) % 3],
             t,
             3 * t + k,
             3 * t + (k + 1) % 3,
             true};
      if (e.low > e.high) {
        e.rising = false;
        std::swap(e.low, e.high);
        std::swap(e.at_low, e.at_high);
      }
      edges.push_back(e);
    }
  std::sort(edges.begin(), edges.end());
  return edges;
}

// Calls use(edges) for every pair of vertices, with all edges between them.
template <typename Use>
void for_each_edge(const std::vector<Edge>& edges, Use use) {
  for (std::size_t first = 0; first < edges.size();) {
    std::size_t last = first + 1;
    while (last < edges.size() && edges[last].low == edges[first].low &&
           edges[last].high == edges[first].high)
      ++last;
    use(std::span(edges).subspan(first, last - first));
    first = last;
  }
}

// Corners that share a smooth edge at their vertex have one normal.
DisjointSets smoothing_groups(const TriangleMesh& mesh, const std::vector<Edge>& edges,
                              const std::vector<std::uint32_t>& part, double crease_degrees) {
  const double least_cosine = std::cos(crease_degrees * std::numbers::pi / 180);
  const std::vector<Vec3> normals = unit_normals(mesh);
  DisjointSets groups(static_cast<std::uint32_t>(mesh.triangles.size() * 3));
  for_each_edge(edges, [&](std::span<const Edge> shared) {
    if (shared.size() != 2) return;
    const Edge& e = shared[0];
    const Edge& f = shared[1];
    if (part[e.triangle] != part[f.triangle] ||
        normals[e.triangle].dot(normals[f.triangle]) < least_cosine)
      return;
    groups.unite(e.at_low, f.at_low);
    groups.unite(e.at_high, f.at_high);
  });
  return groups;
}

bool is_closed(const TriangleMesh& mesh, const std::vector<Edge>& edges) {
  bool closed = !edges.empty();
  for_each_edge(edges, [&](std::span<const Edge> shared) {
    closed = closed && shared.size() == 2 && shared[0].rising != shared[1].rising;
  });
  for (const MeshPart& part : mesh.parts) closed = closed && signed_volume(mesh, part) > 0;
  return closed;
}

std::array<float, 3> corner_angles(const TriangleMesh& mesh, const Triangle& t) {
  std::array<float, 3> angles{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 u = mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]];
    const Vec3 v = mesh.positions[t[(k + 2) % 3]] - mesh.positions[t[k]];
    angles[k] = static_cast<float>(std::atan2(u.cross(v).norm(), u.dot(v)));
  }
  return angles;
}

}  // namespace

SplitSurface split_at_creases(const TriangleMesh& mesh, double crease_degrees) {
  constexpr std::uint32_t kNone = 0xffffffff;
  const std::vector<std::uint32_t> part = part_of_triangle(mesh);
  const std::vector<Edge> edges = sorted_edges(mesh);
  DisjointSets groups = smoothing_groups(mesh, edges, part, crease_degrees);
  SplitSurface surface;
  surface.closed = is_closed(mesh, edges);
  std::vector<std::uint32_t> drawn(mesh.triangles.size() * 3, kNone);  // of each group's root
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle triangle{};
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint32_t& vertex = drawn[groups.lowest(3 * t + k)];
      if (vertex == kNone) {
        vertex = static_cast<std::uint32_t>(surface.source.size());
        surface.source.push_back(mesh.triangles[t][k]);
        surface.part.push_back(part[t]);
      }
      triangle[k] = vertex;
    }
    surface.triangles.push_back(triangle);
    surface.corner_angle.push_back(corner_angles(mesh, mesh.triangles[t]));
  }
  return surface;
}

std::vector<Eigen::Vector3f> vertex_normals(const SplitSurface& surface,
                                            const std::vector<Vec3>& positions) {
  std::vector<Eigen::Vector3f> normals(surface.source.size(), Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Triangle& t = surface.triangles[i];
    const Vec3& o = positions[surface.source[t[0]]];
    const Vec3 cross =
        (positions[surface.source[t[1]]] - o).cross(positions[surface.source[t[2]]] - o);
    const double area = cross.norm();
    if (!(area > 0)) continue;
    const Eigen::Vector3f normal = (cross / area).cast<float>();
    for (std::size_t k = 0; k < 3; ++k) normals[t[k]] += surface.corner_angle[i][k] * normal;
  }
  for (Eigen::Vector3f& n : normals) n.normalize();
  return normals;
}

}  // namespace springlod::inline model
