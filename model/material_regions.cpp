#include "model/material_regions.hpp"

#include "base/disjoint_sets.hpp"

namespace springlod::inline model {

std::vector<std::vector<std::uint32_t>> material_regions(const MassSpringModel& model) {
  DisjointSets sets(model.node_count());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    if (model.material[model.a[s]] == model.material[model.b[s]])
      sets.unite(model.a[s], model.b[s]);
  const DisjointSets::Numbers numbers = sets.numbers();
  std::vector<std::vector<std::uint32_t>> regions(numbers.count);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) regions[numbers.of[i]].push_back(i);
  return regions;
}

}  // namespace springlod::inline model
