#include "model/mesh.hpp"

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"

namespace springlod::inline model {

Box3 bounds(const TriangleMesh& mesh) {
  return bounds(mesh.positions);
}

double signed_volume(const TriangleMesh& mesh, const MeshPart& part) {
  if (part.triangle_count == 0) return 0;
  // Relative to a vertex of the part: far from the origin, cancellation would lose digits.
  const Vec3 o = mesh.positions[mesh.triangles[part.first_triangle][0]];
  double six_volumes = 0;
  for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
    const Triangle& tri = mesh.triangles[part.first_triangle + t];
    six_volumes += (mesh.positions[tri[0]] - o)
                       .dot((mesh.positions[tri[1]] - o).cross(mesh.positions[tri[2]] - o));
  }
  return six_volumes / 6;
}

double surface_area(const TriangleMesh& mesh) {
  double area = 0;
  for (const MeshPart& part : mesh.parts) area += surface_area(mesh, part);
  return area;
}

double surface_area(const TriangleMesh& mesh, const MeshPart& part) {
  double area = 0;
  for (std::uint32_t i = 0; i < part.triangle_count; ++i) {
    const Triangle& t = mesh.triangles[part.first_triangle + i];
    area += 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]])
                      .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                      .norm();
  }
  return area;
}

void validate(const TriangleMesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    if (!mesh.positions[i].allFinite())
      throw InputError(
          fmt::format("mesh: vertex {} is not finite; repair the mesh", script_number(i)));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (v >= mesh.positions.size())
        throw InputError(fmt::format("mesh: triangle {} refers to vertex {}, but there are only {}",
                                     script_number(t), script_number(v), mesh.positions.size()));
  std::size_t next = 0;
  for (const MeshPart& part : mesh.parts) {
    if (part.first_triangle != next)
      throw InputError(fmt::format("mesh: part \"{}\" starts at triangle {}, not at {}", part.name,
                                   part.first_triangle, next));
    next += part.triangle_count;
  }
  if (next != mesh.triangles.size())
    throw InputError(
        fmt::format("mesh: the parts cover {} of {} triangles", next, mesh.triangles.size()));
}

}  // namespace springlod::inline model
