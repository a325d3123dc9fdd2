#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/moduli.hpp"
#include "elastic/moduli/balanced_solver.hpp"
#include "elastic/stiffness.hpp"

namespace springlod::elastic {
namespace {

/// Subtracts the resultant force and torque on each connected component: nodal shares of the areas
/// are in equilibrium only approximately.
void balance(const MassSpringModel& model, const Components& components, Eigen::VectorXd& force) {
  struct Component {
    double nodes = 0;
    Vec3 centre = Vec3::Zero(), push = Vec3::Zero(), torque = Vec3::Zero();
    Mat3 inertia = Mat3::Zero();
    Vec3 rotation = Vec3::Zero();
  };
  std::vector<Component> all(components.count);
  const auto at = [](std::uint32_t i) { return 3 * static_cast<Eigen::Index>(i); };
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Component& component = all[components.of_node[i]];
    component.nodes += 1;
    component.centre += model.rest[i];
    component.push += force.segment<3>(at(i));
  }
  for (Component& component : all) {
    component.centre /= component.nodes;
    component.push /= component.nodes;
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Component& component = all[components.of_node[i]];
    const Vec3 r = model.rest[i] - component.centre;
    component.torque += r.cross(force.segment<3>(at(i)));
    component.inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  for (Component& component : all)
    component.rotation =
        component.inertia.completeOrthogonalDecomposition().solve(component.torque);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Component& component = all[components.of_node[i]];
    force.segment<3>(at(i)) -=
        component.push + component.rotation.cross(model.rest[i] - component.centre);
  }
}

/// Mean gradient of a displacement field: the closest affine field, nodes weighted by volume.
/// Unlike the work of the tractions, it does not depend on how evenly these are distributed over
/// nodes.
Mat3 mean_gradient(const MassSpringModel& model, const Eigen::VectorXd& moved) {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Matrix<double, 4, 3> right = Eigen::Matrix<double, 4, 3>::Zero();
  const MassProperties whole = mass_properties(model);
  const double size = std::cbrt(whole.volume);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Eigen::Vector4d row;
    row << 1, (model.rest[i] - whole.center) / size;
    normal += model.volume[i] * row * row.transpose();
    right += model.volume[i] * row * moved.segment<3>(3 * static_cast<Eigen::Index>(i)).transpose();
  }
  return normal.ldlt().solve(right).bottomRows<3>().transpose() / size;
}

}  // namespace

SurfaceStretchResult surface_stretch(const MassSpringModel& model,
                                     const std::vector<Vec3>& surface) {
  if (surface.size() != model.rest.size())
    throw InputError(fmt::format("surface stretch: {} areas for {} nodes; give one for each node",
                                 surface.size(), model.rest.size()));
  const Components components = connected_components(model);
  const BalancedSolver::Matrix stiffness = stiffness_matrix(model);
  const BalancedSolver solver(
      stiffness,
      {.name = "surface stretch", .advice = "zero_modes lists the mechanisms of the model"});
  const double volume = mass_properties(model).volume;
  double stretch = 0;      // sum of longitudinal strain / stress: 3 / E
  double contraction = 0;  // 6 nu / E
  for (int d = 0; d < 3; ++d) {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(stiffness.rows());
    for (std::size_t i = 0; i < surface.size(); ++i)
      force[3 * static_cast<Eigen::Index>(i) + d] = surface[i][d];
    balance(model, components, force);
    double virial = 0;
    for (std::size_t i = 0; i < surface.size(); ++i)
      virial += force[3 * static_cast<Eigen::Index>(i) + d] * model.rest[i][d];
    if (!(virial > 0))
      throw InputError("surface stretch: the areas do not close a surface around the nodes");
    const Eigen::VectorXd moved = solver.solve(force);
    const Vec3 strain = mean_gradient(model, moved).diagonal() * volume / virial;
    stretch += strain[d];
    contraction -= strain.sum() - strain[d];
  }
  return {3 / stretch, contraction / 2 / stretch};
}

}  // namespace springlod::elastic
