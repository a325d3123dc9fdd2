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

std::uint32_t by_weight(const MeshPart& part, const LodAsset& asset) {
  const MassSpringModel& base = asset.chain.levels[0].model;
  const Binding& binding = asset.surface_of_base;
  std::vector<double> share(base.materials.size(), 0);
  for (std::uint32_t t = 0; t < part.triangle_count; ++t)
    for (const std::uint32_t v : asset.surface.triangles[part.first_triangle + t])
      for (std::uint32_t e = binding.start[v]; e < binding.start[v + 1]; ++e)
        share[base.material[binding.node[e]]] += std::abs(binding.weight[e]);
  return static_cast<std::uint32_t>(std::max_element(share.begin(), share.end()) - share.begin());
}

}  // namespace

std::vector<std::uint32_t> part_materials(const LodAsset& asset) {
  std::vector<std::uint32_t> materials;
  for (const MeshPart& part : asset.surface.parts)
    materials.push_back(
        by_name(part, asset.chain.levels[0].model.materials).value_or(by_weight(part, asset)));
  return materials;
}

}  // namespace springlod::report
