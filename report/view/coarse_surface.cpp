#include "report/view/coarse_surface.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>

namespace springlod::report {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

std::vector<std::uint32_t> parts_of_vertices(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> part(mesh.positions.size(), 0);
  for (std::size_t p = 0; p < mesh.parts.size(); ++p)
    for (std::uint32_t t = 0; t < mesh.parts[p].triangle_count; ++t)
      for (const std::uint32_t v : mesh.triangles[mesh.parts[p].first_triangle + t])
        part[v] = static_cast<std::uint32_t>(p);
  return part;
}

/// The vertex that stands for each vertex when cells have the edge `cell` [m].
std::vector<std::uint32_t> representatives(const TriangleMesh& mesh,
                                           const std::vector<std::uint32_t>& part, double cell) {
  using Key = std::array<std::int64_t, 4>;
  struct Cluster {
    Vec3 sum = Vec3::Zero();
    double count = 0;
    std::uint32_t nearest = kNone;
  };
  std::map<Key, Cluster> clusters;  // ordered, so that results do not depend on a hash
  const auto key_of = [&](std::uint32_t v) {
    const Vec3& x = mesh.positions[v];
    return Key{part[v], std::llround(x.x() / cell), std::llround(x.y() / cell),
               std::llround(x.z() / cell)};
  };
  const auto count = static_cast<std::uint32_t>(mesh.positions.size());
  std::vector<Cluster*> of(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    of[v] = &clusters[key_of(v)];
    of[v]->sum += mesh.positions[v];
    of[v]->count += 1;
  }
  for (std::uint32_t v = 0; v < count; ++v) {
    const Vec3 mean = of[v]->sum / of[v]->count;
    std::uint32_t& nearest = of[v]->nearest;
    if (nearest == kNone ||
        (mesh.positions[v] - mean).squaredNorm() < (mesh.positions[nearest] - mean).squaredNorm())
      nearest = v;
  }
  std::vector<std::uint32_t> stands(count);
  for (std::uint32_t v = 0; v < count; ++v) stands[v] = of[v]->nearest;
  return stands;
}

std::vector<Triangle> replaced(const std::vector<Triangle>& triangles,
                               const std::vector<std::uint32_t>& stands) {
  std::vector<Triangle> left;
  for (const auto& [a, b, c] : triangles) {
    const Triangle t{stands[a], stands[b], stands[c]};
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) left.push_back(t);
  }
  return left;
}

}  // namespace

CoarseSurface coarse_surface(const TriangleMesh& mesh, std::uint32_t most) {
  const std::vector<std::uint32_t> part = parts_of_vertices(mesh);
  CoarseSurface surface;
  surface.triangles = mesh.triangles;
  // A cell of a flat surface holds two triangles. Each try makes about a third fewer.
  constexpr double kGrowth = 1.2;
  double cell = std::sqrt(2 * surface_area(mesh) / most);
  while (surface.triangles.size() > most && cell > 0) {
    surface.triangles = replaced(mesh.triangles, representatives(mesh, part, cell));
    cell *= kGrowth;
  }
  std::vector<std::uint32_t> number(mesh.positions.size(), kNone);
  for (Triangle& triangle : surface.triangles)
    for (std::uint32_t& v : triangle) {
      if (number[v] == kNone) {
        number[v] = static_cast<std::uint32_t>(surface.vertex.size());
        surface.vertex.push_back(v);
        surface.part.push_back(part[v]);
      }
      v = number[v];
    }
  return surface;
}

}  // namespace springlod::report
