#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/script_number.hpp"
#include "elastic/loads.hpp"
#include "model/material_regions.hpp"

namespace springlod::elastic {
namespace {

using Nodes = std::vector<std::uint32_t>;

}  // namespace

std::vector<StaticLoad> piece_loads(const MassSpringModel& model, const PieceLoadOptions& options) {
  std::vector<Nodes> regions = material_regions(model);
  if (regions.size() == 1) return {};
  std::erase_if(regions, [&](const Nodes& region) { return region.size() < options.least_nodes; });
  std::stable_sort(regions.begin(), regions.end(),
                   [](const Nodes& p, const Nodes& q) { return p.size() > q.size(); });
  regions.resize(std::min(regions.size(), options.most_regions));

  std::vector<StaticLoad> loads;
  MassSpringModel alone;  // what smooth_loads reads: they are forces per volume
  alone.rest = model.rest;
  for (const Nodes& region : regions) {
    alone.volume.assign(model.node_count(), 0);
    for (const std::uint32_t i : region) alone.volume[i] = model.volume[i];
    const std::uint32_t first = region.front();
    for (StaticLoad& load : smooth_loads(alone)) {
      load.name += fmt::format(" of {} at node {}", model.materials[model.material[first]].name,
                               script_number(first));
      loads.push_back(std::move(load));
    }
  }
  return loads;
}

}  // namespace springlod::elastic
