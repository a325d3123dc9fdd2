#include "sim/contact/contact_points.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <fmt/format.h>

#include "base/script_number.hpp"
#include "sim/contact/body_surface.hpp"

namespace springlod::sim {
namespace {

// Smallest moment of the nodes of a point about their mean over the largest [1]: of nodes nearer to
// a plane than a tenth of their extent, small displacements would turn the surface.
constexpr double kLeastMoment = 1e-2;

/// Mean damping time of the springs of each node [s], N; 0 for a node without springs.
std::vector<double> damping_times(const MassSpringModel& model) {
  std::vector<double> damping(model.node_count(), 0);
  std::vector<double> stiffness(model.node_count(), 0);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    for (const std::uint32_t node : {model.a[s], model.b[s]}) {
      damping[node] += model.damping[s];
      stiffness[node] += model.stiffness[s];
    }
  for (std::size_t i = 0; i < damping.size(); ++i)
    if (stiffness[i] > 0) damping[i] /= stiffness[i];
  return damping;
}

}  // namespace

ContactPoints::ContactPoints(const MassSpringModel& model, const HeldNodes* held)
    : node_mass_(model.mass), names_(model.surface.empty() ? Names::nodes : Names::surface) {
  const BodySurface surface = body_surface(model);
  for (std::uint32_t p = 0; p < surface.count(); ++p)
    if (add_shares(surface.of_nodes, p, held))
      end_point(model, surface.node[p], {.area = surface.area[p], .contact = surface.contact[p]},
                held);
}

ContactPoints::ContactPoints(const MassSpringModel& model, const ContactSkin& skin,
                             const HeldNodes* held)
    : node_mass_(model.mass), names_(Names::skin) {
  validate(skin, node_count());
  const Binding& of_nodes = skin.of_nodes;
  for (std::uint32_t p = 0; p < of_nodes.point_count(); ++p)
    if (add_shares(of_nodes, p, held))
      end_point(
          model, skin.base_node[p],
          {.area = skin.area[p], .contact = skin.contact[p], .compliance = skin.compliance[p]},
          held);
  const std::vector<double> damping = damping_times(model);
  gradient_.assign(shares_.size(), Vec3::Zero());
  for (std::uint32_t p = 0; p < count(); ++p) {
    set_gradients(model, p);
    compliance_damping_[p] = 0;
    for (const Share& share : shares(p))
      compliance_damping_[p] += std::abs(share.weight) / reach_[p] * damping[share.node];
  }
}

bool ContactPoints::add_shares(const Binding& of_nodes, std::uint32_t point,
                               const HeldNodes* held) {
  bool moves = held == nullptr;
  for (std::uint32_t e = of_nodes.start[point]; e < of_nodes.start[point + 1]; ++e) {
    shares_.push_back({.node = of_nodes.node[e], .weight = of_nodes.weight[e]});
    moves = moves || !held->holds(of_nodes.node[e]);
  }
  if (!moves) shares_.resize(start_.back());
  return moves;
}

void ContactPoints::end_point(const MassSpringModel& model, std::uint32_t number,
                              const Surface& surface, const HeldNodes* held) {
  const auto is_held = [&](const Share& share) {
    return held != nullptr && held->holds(share.node);
  };
  const std::uint32_t first = start_.back();
  start_.push_back(static_cast<std::uint32_t>(shares_.size()));
  double mobility = 0;
  double reach = 0;
  for (std::size_t e = first; e < shares_.size(); ++e) {
    if (!is_held(shares_[e]))
      mobility += shares_[e].weight * shares_[e].weight / model.mass[shares_[e].node];
    reach += std::abs(shares_[e].weight);
  }
  const bool is_node = shares_.size() == first + 1 && shares_[first].weight == 1;  // to the bit
  const double mass = is_node ? model.mass[shares_[first].node] : 1 / mobility;
  for (std::size_t e = first; e < shares_.size(); ++e)
    shares_[e].kick = is_held(shares_[e]) ? 0
                      : is_node           ? 1
                                          : shares_[e].weight * mass / model.mass[shares_[e].node];
  area_.push_back(surface.area);
  automatic_stiffness_.push_back(surface.contact);
  compliance_.push_back(surface.compliance);
  turns_.push_back(0);
  compliance_damping_.push_back(0);
  mass_.push_back(mass);
  reach_.push_back(reach);
  number_.push_back(number);
}

// The gradients of a linear fit to the nodes: they reproduce every affine motion.
void ContactPoints::set_gradients(const MassSpringModel& model, std::uint32_t point) {
  if (!yields(point)) return;
  const std::span<const Share> of_point = shares(point);
  Vec3 center = Vec3::Zero();
  for (const Share& share : of_point)
    center += model.rest[share.node] / static_cast<double>(of_point.size());
  Mat3 moments = Mat3::Zero();
  for (const Share& share : of_point) {
    const Vec3 arm = model.rest[share.node] - center;
    moments += arm * arm.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(moments);
  if (!(axes.eigenvalues()[0] > kLeastMoment * axes.eigenvalues()[2])) {
    // The nodes of the point do not show how the surface turns.
    compliance_[point] = compliance_[point].trace() / 3 * Mat3::Identity();
    return;
  }
  turns_[point] = 1;
  const Mat3 inverse = moments.inverse();
  for (std::uint32_t e = start_[point]; e < start_[point + 1]; ++e)
    gradient_[e] = inverse * (model.rest[shares_[e].node] - center);
}

ContactPoints::Yielding ContactPoints::yielding(std::size_t point, const Vec3& normal,
                                                const Mat3& frame) const {
  if (!yields(point)) return {};
  const Mat3 compliance = frame * compliance_[point] * frame.transpose();
  const Vec3 yield = compliance * normal;
  const double along = normal.dot(yield);
  return {.normal = along,
          .tangential = (compliance.trace() - along) / 2,
          .sideways = yield - along * normal};
}

std::string ContactPoints::name(std::size_t point) const {
  return fmt::format("{} {}{}", names_ == Names::nodes ? "node" : "the surface at node",
                     script_number(number(point)), names_ == Names::skin ? " of the base" : "");
}

}  // namespace springlod::sim
