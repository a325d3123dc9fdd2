#include "model/creases.hpp"

#include <cmath>
#include <numeric>

namespace springlod {
namespace {

/// Triangles by vertex, compressed rows.
struct Fans {
  std::vector<std::uint32_t> start;
  std::vector<std::uint32_t> triangle;
};

Fans fans(const TriangleMesh& mesh) {
  Fans f;
  f.start.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) ++f.start[v + 1];
  std::partial_sum(f.start.begin(), f.start.end(), f.start.begin());
  f.triangle.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(f.start.begin(), f.start.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t]) f.triangle[next[v]++] = t;
  return f;
}

}  // namespace

ShadedMesh split_at_creases(const TriangleMesh& mesh, double crease_degrees) {
  constexpr double kPi = 3.14159265358979323846;
  const double least_cosine = std::cos(crease_degrees * kPi / 180);
  std::vector<Vec3> area(mesh.triangles.size());  // twice the area along the normal
  for (std::size_t t = 0; t < area.size(); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    area[t] = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
  }
  const Fans fan = fans(mesh);
  ShadedMesh shaded;
  shaded.triangles = mesh.triangles;
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    const std::size_t first = shaded.vertex.size();
    for (std::uint32_t e = fan.start[v]; e < fan.start[v + 1]; ++e) {
      const std::uint32_t t = fan.triangle[e];
      Vec3 normal = Vec3::Zero();
      for (std::uint32_t f = fan.start[v]; f < fan.start[v + 1]; ++f) {
        const Vec3& other = area[fan.triangle[f]];
        if (area[t].dot(other) >= least_cosine * area[t].norm() * other.norm()) normal += other;
      }
      normal = normal.norm() > 0 ? Vec3(normal.stableNormalized()) : Vec3(Vec3::UnitZ());
      // Triangles on the same side sum up the same normals in the same order: the same bits.
      std::size_t at = first;
      while (at < shaded.vertex.size() && shaded.normals[at] != normal) ++at;
      if (at == shaded.vertex.size()) {
        shaded.vertex.push_back(v);
        shaded.normals.push_back(normal);
      }
      for (std::size_t corner = 0; corner < 3; ++corner)
        if (mesh.triangles[t][corner] == v)
          shaded.triangles[t][corner] = static_cast<std::uint32_t>(at);
    }
  }
  return shaded;
}

}  // namespace springlod
