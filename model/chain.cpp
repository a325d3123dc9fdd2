#include "model/chain.hpp"

#include <numeric>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/ranges.hpp"

namespace springlod::inline model {

Groups identity_groups(std::uint32_t node_count) {
  Groups groups{std::vector<std::uint32_t>(node_count), node_count};
  std::iota(groups.of.begin(), groups.of.end(), 0U);
  return groups;
}

Groups compose(const Groups& finer, const Groups& coarser) {
  if (coarser.of.size() != finer.count)
    throw InputError(
        fmt::format("groups: the finer map has {} groups, but the coarser map has {} entries",
                    finer.count, coarser.of.size()));
  Groups composed{std::vector<std::uint32_t>(finer.of.size()), coarser.count};
  for (std::size_t i = 0; i < finer.of.size(); ++i) composed.of[i] = coarser.of[finer.of[i]];
  return composed;
}

std::vector<std::uint32_t> mapped_nodes(const Groups& groups,
                                        const std::vector<std::uint32_t>& nodes) {
  std::vector<bool> holds(groups.count, false);
  for (const std::uint32_t node : nodes) {
    if (node >= groups.of.size())
      throw InputError(fmt::format("groups: there is no node {}; the map has {} nodes",
                                   script_number(node), groups.of.size()));
    holds[groups.of[node]] = true;
  }
  std::vector<std::uint32_t> coarse;
  for (std::uint32_t g = 0; g < groups.count; ++g)
    if (holds[g]) coarse.push_back(g);
  return coarse;
}

void validate(const Groups& groups) {
  std::vector<bool> seen(groups.count, false);
  for (std::size_t i = 0; i < groups.of.size(); ++i) {
    if (groups.of[i] >= groups.count)
      throw InputError(fmt::format("groups: node {} is in group {}, but there are only {}",
                                   script_number(i), script_number(groups.of[i]), groups.count));
    seen[groups.of[i]] = true;
  }
  for (std::uint32_t g = 0; g < groups.count; ++g)
    if (!seen[g]) throw InputError(fmt::format("groups: group {} is empty", script_number(g)));
}

void Provenance::set(const std::string& key, const std::string& value) {
  for (auto& [k, v] : entries)
    if (k == key) {
      v = value;
      return;
    }
  entries.emplace_back(key, value);
}

const Level& level_at(const LodChain& chain, std::uint32_t level) {
  if (level >= chain.levels.size())
    throw InputError(fmt::format("chain: there is no level {}; use a level from 0 to {}", level,
                                 chain.levels.size() - 1));
  return chain.levels[level];
}

void validate(const LodAsset& asset) {
  if (asset.chain.levels.empty()) throw InputError("asset: the chain has no levels");
  const std::uint32_t base = asset.chain.levels[0].model.node_count();
  for (std::size_t n = 0; n < asset.chain.levels.size(); ++n) {
    const Level& level = asset.chain.levels[n];
    try {
      validate(level.model);
      validate(level.of_base);
      if (level.certificate) validate(*level.certificate);
    } catch (const InputError& e) {
      throw InputError(fmt::format("level {}: {}", n, e.what()));
    }
    if (level.of_base.of.size() != base || level.of_base.count != level.model.node_count())
      throw InputError(
          fmt::format("level {}: its map must have {} base nodes and {} groups, one for each node",
                      n, base, level.model.node_count()));
  }
  validate(asset.surface);
  for (std::size_t v = 0; v < asset.surface.positions.size(); ++v)
    for (const double coordinate : asset.surface.positions[v])
      if (!range::kCoordinate.contains(coordinate))
        throw InputError(fmt::format("surface: vertex {}: {}", script_number(v),
                                     outside("position", coordinate, range::kCoordinate)));
  const std::uint32_t bound = asset.surface_of_base.point_count();
  if (bound != asset.surface.positions.size())
    throw InputError(
        fmt::format("asset: the surface has {} vertices, but {} of them are bound; bind all",
                    asset.surface.positions.size(), bound));
  validate(asset.surface_of_base, base);
}

}  // namespace springlod::inline model
