#include "sim/study/twin.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "lod/transfer.hpp"
#include "sim/contact/body_surface.hpp"

namespace springlod::sim {
namespace {

/// For each node of a finer level, the coarse node that contains the nearest base node of its
/// group. If the coarse level was merged from the finer one, it contains the whole group.
std::vector<std::uint32_t> coarse_of_fine(const LodChain& chain, std::uint32_t level,
                                          std::uint32_t coarse) {
  const MassSpringModel& base = chain.levels[0].model;
  const MassSpringModel& fine = chain.levels[level].model;
  const Groups& to_fine = chain.levels[level].of_base;
  const Groups& to_coarse = chain.levels[coarse].of_base;
  std::vector<double> nearest(fine.node_count(), std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> group(fine.node_count(), 0);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    const std::uint32_t node = to_fine.of[i];
    const double distance = (base.rest[i] - fine.rest[node]).squaredNorm();
    if (distance >= nearest[node]) continue;
    nearest[node] = distance;
    group[node] = to_coarse.of[i];
  }
  return group;
}

}  // namespace

ContactSkin nodes_of_level_as_skin(const LodChain& chain, std::uint32_t level,
                                   std::uint32_t coarse) {
  const MassSpringModel& fine = level_at(chain, level).model;
  const MassSpringModel& body = level_at(chain, coarse).model;
  const std::vector<std::uint32_t> group = coarse_of_fine(chain, level, coarse);
  const BodySurface surface = body_surface(fine);
  ContactSkin skin;
  std::vector<lod::GroupPoint> points;
  skin.area = surface.area;
  skin.base_node = surface.node;
  skin.contact = surface.contact;
  for (std::uint32_t p = 0; p < surface.count(); ++p) {
    const std::uint32_t i = surface.node[p];
    points.push_back({surface.position[p], group[i]});
    const double lost = std::max(0.0, 1 - fine.mass[i] / body.mass[group[i]]);
    skin.compliance.emplace_back((surface.stiffness[p] > 0 ? lost / surface.stiffness[p] : 0) *
                                 Mat3::Identity());
  }
  skin.of_nodes = lod::points_from_groups(points, body);
  return skin;
}

MassSpringModel stiffened(const MassSpringModel& model, double factor) {
  MassSpringModel changed = model;
  for (double& k : changed.stiffness) k *= factor;
  for (double& c : changed.damping) c *= factor;
  for (double& modulus : changed.dilatation.modulus) modulus *= factor;
  for (double& k : changed.surface.stiffness) k *= factor;
  return changed;
}

}  // namespace springlod::sim
