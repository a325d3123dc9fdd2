#include "lod/calibration/level_variables.hpp"

#include <cmath>

namespace springlod::lod {
namespace {

/// Change of ln m per unit of theta; ln k changes by 1 (docs/method.md, eq. 29).
constexpr double kMassScale = 0.5;

}  // namespace

MassSpringModel LevelVariables::with_springs(const Eigen::VectorXd& theta) const {
  MassSpringModel model = start_;
  for (std::uint32_t s = 0; s < start_.spring_count(); ++s) {
    const double factor = std::exp(theta[s]);
    model.stiffness[s] *= factor;
    model.damping[s] *= factor;
  }
  return model;
}

MassSpringModel LevelVariables::model(const Eigen::VectorXd& theta) const {
  MassSpringModel model = with_springs(theta);
  for (std::uint32_t i = 0; i < start_.node_count(); ++i)
    model.mass[i] *= std::exp(kMassScale * theta[springs() + i]);
  moments_.restore(model.mass);
  return model;
}

MassSpringModel LevelVariables::model(const FitPoint& point) const {
  MassSpringModel model = with_springs(point.theta);
  model.mass = point.mass;
  return model;
}

void LevelVariables::masses_to_theta(const std::vector<double>& mass,
                                     Eigen::VectorXd& theta) const {
  for (std::uint32_t i = 0; i < start_.node_count(); ++i)
    theta[springs() + i] = std::log(mass[i] / start_.mass[i]) / kMassScale;
}

void LevelVariables::project_jacobian(const std::vector<double>& mass,
                                      Eigen::MatrixXd& jacobian) const {
  auto by_mass = jacobian.bottomRows(nodes());
  by_mass *= kMassScale;
  moments_.project(mass, by_mass);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> LevelVariables::scaled_jacobian(
    const Eigen::SparseMatrix<double, Eigen::RowMajor>& jacobian) const {
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(count());
  scale.tail(nodes()).setConstant(kMassScale);
  return jacobian * scale.asDiagonal();
}

}  // namespace springlod::lod
