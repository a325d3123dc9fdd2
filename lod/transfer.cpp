#include "lod/transfer.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {
namespace {

// Largest number of nodes per interpolated point: enough for smooth weights. More nodes smooth the
// field further and take time.
constexpr std::size_t kMostNodes = 12;

// The group's own node, then its spring neighbours in the order of their distance to `point`.
std::vector<std::uint32_t> nearest_neighbourhood(const MassSpringModel& model,
                                                 const SpringRows& springs, std::uint32_t node,
                                                 const Vec3& point) {
  std::vector<std::uint32_t> nodes;
  springs.for_each(node, [&](std::uint32_t other, std::uint32_t) { nodes.push_back(other); });
  const auto nearer = [&](std::uint32_t i, std::uint32_t j) {
    const double di = (model.rest[i] - point).squaredNorm();
    const double dj = (model.rest[j] - point).squaredNorm();
    return di != dj ? di < dj : i < j;
  };
  std::sort(nodes.begin(), nodes.end(), nearer);
  nodes.insert(nodes.begin(), node);
  if (nodes.size() > kMostNodes) nodes.resize(kMostNodes);
  return nodes;
}

Binding identity_binding(std::uint32_t count) {
  Binding binding;
  for (std::uint32_t i = 0; i < count; ++i) {
    binding.start.push_back(i);
    binding.node.push_back(i);
    binding.weight.push_back(1);
  }
  binding.start.push_back(count);
  return binding;
}

}  // namespace

Binding fine_from_coarse(const MassSpringModel& fine, const MassSpringModel& coarse,
                         const Groups& groups) {
  const SpringRows springs(coarse);
  Binding binding;
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    append_bound_point(binding, fine.rest[i], coarse,
                       nearest_neighbourhood(coarse, springs, groups.of[i], fine.rest[i]));
  return binding;
}

Binding base_from_level(const LodChain& chain, std::uint32_t level) {
  if (level >= chain.levels.size())
    throw InputError(fmt::format("transfer: there is no level {}; use a level from 0 to {}", level,
                                 chain.levels.size() - 1));
  const MassSpringModel& base = chain.levels[0].model;
  if (level == 0) return identity_binding(base.node_count());
  return fine_from_coarse(base, chain.levels[level].model, chain.levels[level].of_base);
}

}  // namespace springlod::lod
