#include "sim/contact/contact_skin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "lod/transfer.hpp"
#include "sim/contact/body_surface.hpp"
#include "sim/contact/lost_compliance.hpp"
#include "sim/contact/skin_patches.hpp"

namespace springlod::sim {
namespace {

/// Fraction of its degrees of freedom that each node lost by joining its group [1], 0 for a group
/// of one: first factor of eq. 65 of docs/method.md. (Two equal nodes joined by stiffness b and
/// held by a - b: each alone is more compliant than both together by 1 / (2 (a + b)), less than
/// half of 1 / a.)
std::vector<double> lost_freedom_of_nodes(const MassSpringModel& base, const Groups& groups) {
  std::vector<double> mass(groups.count, 0);
  for (std::uint32_t i = 0; i < base.node_count(); ++i) mass[groups.of[i]] += base.mass[i];
  std::vector<double> lost;
  for (std::uint32_t i = 0; i < base.node_count(); ++i)
    lost.push_back(1 - base.mass[i] / mass[groups.of[i]]);
  return lost;
}

/// The same of each point, by the weights of its nodes.
std::vector<double> lost_freedom(const BodySurface& surface, const MassSpringModel& base,
                                 const Groups& groups) {
  const std::vector<double> of_nodes = lost_freedom_of_nodes(base, groups);
  const Binding& binding = surface.of_nodes;
  std::vector<double> lost;
  for (std::uint32_t p = 0; p < surface.count(); ++p) {
    double sum = 0;
    for (std::uint32_t e = binding.start[p]; e < binding.start[p + 1]; ++e)
      sum += binding.weight[e] * of_nodes[binding.node[e]];
    lost.push_back(std::max(0.0, sum));
  }
  return lost;
}

std::vector<std::vector<std::uint32_t>> each_alone(std::uint32_t count) {
  std::vector<std::vector<std::uint32_t>> alone;
  for (std::uint32_t i = 0; i < count; ++i) alone.push_back({i});
  return alone;
}

/// The points of a surface as a skin: of the base itself.
ContactSkin skin_of_base(const BodySurface& surface) {
  return {.of_nodes = surface.of_nodes,
          .area = surface.area,
          .base_node = surface.node,
          .contact = surface.contact,
          .compliance = std::vector<Mat3>(surface.count(), Mat3::Zero())};
}

// Stiffness of a point that lost no freedom [N/m].
constexpr double kRigid = std::numeric_limits<double>::infinity();

// Smallest compliance of a point in any direction over the estimate of eq. 65 [1]. A level is more
// compliant than its base where the nodes of a point happen to be soft.
constexpr double kLeastCompliance = 0.2;

/// The symmetric matrix with no eigenvalue below `least`.
Mat3 at_least(double least, const Mat3& matrix) {
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(matrix);
  const Vec3 along = axes.eigenvalues().cwiseMax(least);
  return axes.eigenvectors() * along.asDiagonal() * axes.eigenvectors().transpose();
}

bool is_compliance(const Mat3& compliance) {
  constexpr double kRounding = 1e-9;  // over the largest entry [1]
  if (!compliance.allFinite()) return false;
  const double rounding = kRounding * compliance.cwiseAbs().maxCoeff();
  return (compliance - compliance.transpose()).cwiseAbs().maxCoeff() <= rounding &&
         Eigen::SelfAdjointEigenSolver<Mat3>(compliance, Eigen::EigenvaluesOnly).eigenvalues()[0] >=
             -rounding;
}

}  // namespace

ContactSkin contact_skin(const LodChain& chain, std::uint32_t level) {
  const Level& skinned = level_at(chain, level);
  const MassSpringModel& base = chain.levels[0].model;
  const Groups& groups = skinned.of_base;
  const BodySurface surface = body_surface(base);
  if (level == 0) return skin_of_base(surface);
  const std::vector<double> lost = lost_freedom(surface, base, groups);
  std::vector<SurfacePoint> points;
  for (std::uint32_t p = 0; p < surface.count(); ++p)
    points.push_back(
        {groups.of[surface.node[p]], surface.position[p], surface.normal[p], surface.area[p]});
  ContactSkin skin;
  std::vector<lod::GroupPoint> means;
  Binding of_base;
  of_base.start.push_back(0);
  std::vector<double> estimate;  // of the compliance [m/N]
  const Binding& rows = surface.of_nodes;
  // The mean of a patch of a true surface would lie below it, and touch late.
  const std::vector<std::vector<std::uint32_t>> patches =
      base.surface.empty() ? flat_patches(points, mean_spring_length(base))
                           : each_alone(surface.count());
  for (const std::vector<std::uint32_t>& patch : patches) {
    double area = 0;
    Vec3 moment = Vec3::Zero();  // sum of area times position [m3]
    double contact = 0;
    double yielding = 0;  // inverse compliance: the nodes yield in parallel [N/m]
    for (const std::uint32_t p : patch) {
      area += surface.area[p];
      moment += surface.area[p] * surface.position[p];
      contact += surface.contact[p];
      if (lost[p] > 0)
        yielding += surface.stiffness[p] / lost[p];
      else
        yielding = kRigid;
    }
    for (const std::uint32_t p : patch)
      for (std::uint32_t e = rows.start[p]; e < rows.start[p + 1]; ++e) {
        of_base.node.push_back(rows.node[e]);
        of_base.weight.push_back(rows.weight[e] * surface.area[p] / area);
      }
    of_base.start.push_back(static_cast<std::uint32_t>(of_base.node.size()));
    means.push_back({moment / area, groups.of[surface.node[patch.front()]]});
    skin.area.push_back(area);
    skin.base_node.push_back(surface.node[patch.front()]);
    skin.contact.push_back(contact);
    estimate.push_back(yielding > 0 ? 1 / yielding : 0);
  }
  skin.of_nodes = lod::points_from_groups(means, skinned.model);
  skin.compliance.assign(means.size(), Mat3::Zero());
  const std::vector<std::optional<Mat3>> removed =
      lost_compliance(chain, level, {of_base, skin.of_nodes, means});
  for (std::size_t p = 0; p < means.size(); ++p) {
    if (!(estimate[p] > 0)) continue;
    skin.compliance[p] = removed[p] ? at_least(kLeastCompliance * estimate[p], *removed[p])
                                    : Mat3(estimate[p] * Mat3::Identity());
  }
  return skin;
}

void validate(const ContactSkin& skin, std::uint32_t node_count) {
  validate(skin.of_nodes, node_count);
  const std::uint32_t points = skin.of_nodes.point_count();
  if (skin.area.size() != points || skin.base_node.size() != points ||
      skin.contact.size() != points || skin.compliance.size() != points)
    throw InputError(
        fmt::format("contact skin: {} areas, {} nodes of the base, {} contact stiffnesses and {} "
                    "compliances for {} points",
                    skin.area.size(), skin.base_node.size(), skin.contact.size(),
                    skin.compliance.size(), points));
  for (std::uint32_t p = 0; p < points; ++p) {
    if (!(std::isfinite(skin.area[p]) && skin.area[p] > 0))
      throw InputError(fmt::format("contact skin: the area of point {} is {}; it must be above 0",
                                   script_number(p), skin.area[p]));
    if (!(std::isfinite(skin.contact[p]) && skin.contact[p] > 0))
      throw InputError(
          fmt::format("contact skin: the contact stiffness of point {} is {}; it must be above 0",
                      script_number(p), skin.contact[p]));
    if (!is_compliance(skin.compliance[p]))
      throw InputError(
          fmt::format("contact skin: the compliance of point {} must be finite, symmetric and "
                      "positive semidefinite",
                      script_number(p)));
    if (skin.of_nodes.start[p] == skin.of_nodes.start[p + 1])
      throw InputError(fmt::format("contact skin: point {} is bound to no node", script_number(p)));
  }
}

}  // namespace springlod::sim
