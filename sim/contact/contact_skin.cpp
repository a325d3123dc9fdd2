#include "sim/contact/contact_skin.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "elastic/stable_step.hpp"
#include "lod/transfer.hpp"

namespace springlod::sim {
namespace {

/// Compliance of each node with its neighbours held, along the mean direction of its springs
/// [m/N]: second factor of eq. 65 of docs/method.md. 0 where the springs have no mean direction.
std::vector<double> own_compliance(const MassSpringModel& model) {
  std::vector<Vec3> inwards(model.node_count(), Vec3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 pull = model.stiffness[s] * spring_direction(model, s);
    inwards[model.a[s]] += pull;
    inwards[model.b[s]] -= pull;
  }
  const std::vector<Mat3> stiffness = elastic::node_stiffness(model);
  std::vector<double> compliance;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 normal = inwards[i].normalized();
    const double along = normal.dot(stiffness[i] * normal);
    compliance.push_back(along > 0 ? 1 / along : 0);
  }
  return compliance;
}

/// Fraction of its degrees of freedom that each node lost by joining its group [1], 0 for a group
/// of one: first factor of eq. 65 of docs/method.md. (Two equal nodes joined by stiffness b and
/// held by a - b: each alone is more compliant than both together by 1 / (2 (a + b)), less than
/// half of 1 / a.)
std::vector<double> lost_freedom(const MassSpringModel& base, const Groups& groups) {
  std::vector<double> mass(groups.count, 0);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) mass[groups.of[i]] += base.mass[i];
  std::vector<double> lost;
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    lost.push_back(1 - base.mass[i] / mass[groups.of[i]]);
  return lost;
}

}  // namespace

ContactSkin contact_skin(const LodChain& chain, std::uint32_t level) {
  const Binding of_nodes = lod::base_from_level(chain, level);
  const MassSpringModel& base = chain.levels[0].model;
  ContactSkin skin;
  skin.of_nodes.start.push_back(0);
  const std::vector<double> compliance = own_compliance(base);
  const std::vector<double> lost = lost_freedom(base, chain.levels[level].of_base);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    if (!(base.contact_area[i] > 0)) continue;
    for (std::uint32_t e = of_nodes.start[i]; e < of_nodes.start[i + 1]; ++e) {
      skin.of_nodes.node.push_back(of_nodes.node[e]);
      skin.of_nodes.weight.push_back(of_nodes.weight[e]);
    }
    skin.of_nodes.start.push_back(static_cast<std::uint32_t>(skin.of_nodes.node.size()));
    skin.area.push_back(base.contact_area[i]);
    skin.base_node.push_back(i);
    skin.compliance.push_back(lost[i] * compliance[i]);
  }
  return skin;
}

void validate(const ContactSkin& skin, std::uint32_t node_count) {
  validate(skin.of_nodes, node_count);
  const std::uint32_t points = skin.of_nodes.point_count();
  if (skin.area.size() != points || skin.base_node.size() != points ||
      skin.compliance.size() != points)
    throw InputError(
        fmt::format("contact skin: {} areas, {} nodes of the base and {} compliances for {} points",
                    skin.area.size(), skin.base_node.size(), skin.compliance.size(), points));
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!(std::isfinite(skin.area[p]) && skin.area[p] > 0))
      throw InputError(fmt::format("contact skin: the area of point {} is {}; it must be above 0",
                                   script_number(p), skin.area[p]));
    if (!(std::isfinite(skin.compliance[p]) && skin.compliance[p] >= 0))
      throw InputError(
          fmt::format("contact skin: the compliance of point {} is {}; it must be 0 or more",
                      script_number(p), skin.compliance[p]));
    if (skin.of_nodes.start[p] == skin.of_nodes.start[p + 1])
      throw InputError(fmt::format("contact skin: point {} is bound to no node", script_number(p)));
  }
}

}  // namespace springlod::sim
