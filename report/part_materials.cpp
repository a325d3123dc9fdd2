#include "report/part_materials.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace springlod::report {

namespace {

std::optional<std::uint32_t> by_name(const MeshPart& part, const std::vector<Material>& materials) {
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    if (materials[m].name == part.name || materials[m].name == part.material) return m;
  return std::nullopt;
}

std::uint32_t by_weight(const MeshPart& part, const TriangleMesh& surface, const Binding& binding,
                        const MassSpringModel& model) {
  std::vector<double> share(model.materials.size(), 0);
  for (std::uint32_t t = 0; t < part.triangle_count; ++t)
    for (const std::uint32_t v : surface.triangles[part.first_triangle + t])
      for (std::uint32_t e = binding.start[v]; e < binding.start[v + 1]; ++e)
        share[model.material[binding.node[e]]] += std::abs(binding.weight[e]);
  return static_cast<std::uint32_t>(std::max_element(share.begin(), share.end()) - share.begin());
}

}  // namespace

std::vector<std::uint32_t> part_materials(const TriangleMesh& surface,
                                          const Binding& surface_of_nodes,
                                          const MassSpringModel& model) {
  std::vector<std::uint32_t> materials;
  for (const MeshPart& part : surface.parts)
    materials.push_back(
        by_name(part, model.materials).value_or(by_weight(part, surface, surface_of_nodes, model)));
  return materials;
}

std::vector<std::uint32_t> part_materials(const LodAsset& asset) {
  return part_materials(asset.surface, asset.surface_of_base, asset.chain.levels[0].model);
}

}  // namespace springlod::report
