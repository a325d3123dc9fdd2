#include "lod/transfer.hpp"

#include <algorithm>

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

Binding points_from_groups(const std::vector<GroupPoint>& points, const MassSpringModel& coarse) {
  const SpringRows springs(coarse);
  Binding binding;
  binding.start.push_back(0);
  for (const GroupPoint& point : points)
    append_bound_point(binding, point.rest, coarse,
                       nearest_neighbourhood(coarse, springs, point.group, point.rest));
  return binding;
}

Binding fine_from_coarse(const MassSpringModel& fine, const MassSpringModel& coarse,
                         const Groups& groups) {
  std::vector<GroupPoint> points;
  for (std::uint32_t i = 0; i < fine.node_count(); ++i)
    points.push_back({fine.rest[i], groups.of[i]});
  return points_from_groups(points, coarse);
}

Binding base_from_level(const LodChain& chain, std::uint32_t level) {
  const Level& from = level_at(chain, level);
  const MassSpringModel& base = chain.levels[0].model;
  if (level == 0) return identity_binding(base.node_count());
  return fine_from_coarse(base, from.model, from.of_base);
}

}  // namespace springlod::lod
