#include "model/asset/gltf_surface.hpp"

#include <cstdint>
#include <string>

#include "model/drawn_colour.hpp"

namespace springlod::inline model {

using nlohmann::json;

std::vector<Vec3> drawn_positions(const SplitSurface& surface, const std::vector<Vec3>& positions) {
  std::vector<Vec3> drawn;
  drawn.reserve(surface.source.size());
  for (const std::uint32_t vertex : surface.source) drawn.push_back(positions[vertex]);
  return drawn;
}

std::vector<Vec3> drawn_normals(const SplitSurface& surface, const std::vector<Vec3>& positions) {
  std::vector<Vec3> normals;
  normals.reserve(surface.source.size());
  for (const Eigen::Vector3f& n : vertex_normals(surface, positions))
    normals.push_back(n.isZero(0) ? Vec3(Vec3::UnitZ()) : Vec3(n.cast<double>()));
  return normals;
}

IndexView add_triangles(GltfBuilder& gltf, const std::vector<Triangle>& triangles) {
  return {gltf.buffer().add(triangles, gltf::Target::indices), gltf::Component::unsigned_int};
}

json part_primitives(GltfBuilder& gltf, const std::vector<MeshPart>& parts,
                     const std::vector<Material>& materials, const json& attributes,
                     const IndexView& triangles) {
  json primitives = json::array();
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const MeshPart& part = parts[p];
    if (part.triangle_count == 0) continue;
    const std::size_t indices = gltf.add_accessor(triangles.view, triangles.component, "SCALAR",
                                                  std::size_t{3} * part.triangle_count);
    if (part.first_triangle > 0)
      gltf.document()["accessors"][indices]["byteOffset"] =
          3 * bytes_of(triangles.component) * part.first_triangle;
    const std::string& name = part.material.empty() ? part.name : part.material;
    primitives.push_back({{"mode", gltf::Mode::triangles},
                          {"attributes", attributes},
                          {"indices", indices},
                          {"material", gltf.add_material(name, part_colour(part, p, materials))}});
  }
  return primitives;
}

}  // namespace springlod::inline model
