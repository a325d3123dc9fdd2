#include "render/cut.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "render/drawables.hpp"

namespace springlod::render {

std::vector<float> kept_distances(const DrawnBody& body) {
  const std::vector<Vec3>& rest = body.surface->positions;
  std::vector<float> distances(rest.size(), 1);
  if (!body.style.cut) return distances;
  const double length = body.style.cut->normal.norm();
  for (std::size_t i = 0; i < rest.size(); ++i)
    distances[i] =
        static_cast<float>((body.style.cut->normal.dot(rest[i]) - body.style.cut->offset) / length);
  return distances;
}

Eigen::Vector4f cut_face(const DrawnBody& body, const Vec3& origin) {
  const std::vector<Vec3>& rest = body.surface->positions;
  const std::vector<Vec3>& now =
      body.surface_positions != nullptr ? *body.surface_positions : body.surface->positions;
  const auto mean = [](const std::vector<Vec3>& points) {
    Vec3 sum = Vec3::Zero();
    for (const Vec3& p : points) sum += p;
    return Vec3(sum / static_cast<double>(points.size()));
  };
  const Vec3 rest_mean = mean(rest);
  const Vec3 now_mean = mean(now);
  Mat3 spread = Mat3::Zero();
  Mat3 moved = Mat3::Zero();
  for (std::size_t i = 0; i < rest.size(); ++i) {
    spread += (rest[i] - rest_mean) * (rest[i] - rest_mean).transpose();
    moved += (now[i] - now_mean) * (rest[i] - rest_mean).transpose();
  }
  const Mat3 map = moved * spread.inverse();
  const DrawnPlane& cut = *body.style.cut;
  // n . x = d at rest; x' = map (x - rest_mean) + now_mean.
  const Vec3 normal = map.inverse().transpose() * cut.normal;
  const double offset = cut.offset - cut.normal.dot(rest_mean) + normal.dot(now_mean - origin);
  const double length = -normal.norm();  // minus: out of the kept part
  if (!normal.allFinite() || length == 0) return Eigen::Vector4f::Zero();
  Eigen::Vector4f face;
  face << (normal / length).cast<float>(), static_cast<float>(offset / length);
  return face;
}

std::vector<CutPart> parts_by_size(const DrawnBody& body) {
  const TriangleMesh& mesh = *body.surface;
  std::vector<std::pair<double, CutPart>> sized;
  for (std::uint32_t i = 0; i < mesh.parts.size(); ++i) {
    const MeshPart& part = mesh.parts[i];
    Box3 box;
    for (std::uint32_t t = 0; t < part.triangle_count; ++t)
      for (const std::uint32_t vertex : mesh.triangles[part.first_triangle + t])
        box.extend(mesh.positions[vertex]);
    sized.emplace_back(box.isEmpty() ? 0 : box.diagonal().norm(),
                       CutPart{part.first_triangle, part.triangle_count, part_colour(body, i)});
  }
  std::stable_sort(sized.begin(), sized.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<CutPart> parts;
  for (const auto& [size, part] : sized) parts.push_back(part);
  return parts;
}

}  // namespace springlod::render
