#include "lod/calibration/level_variables.hpp"

#include <cmath>

namespace springlod::lod {
namespace {

/// Change of ln m per unit of theta; ln k changes by 1 (docs/method.md, eq. 29).
constexpr double kMassScale = 0.5;
/// The same of ln |T|: a fit of frequencies and loads, which say more about shear than about the
/// change of volume, would otherwise change Poisson's ratio more than it gains.
constexpr double kTermScale = 0.2;

}  // namespace

LevelVariables::LevelVariables(const MassSpringModel& start, const FitOptions& options)
    : start_(start) {
  if (options.masses == NodeMasses::free) moments_.emplace(start, options.moments);
}

MassSpringModel LevelVariables::with_stiffness(const Eigen::VectorXd& theta) const {
  MassSpringModel model = start_;
  for (std::uint32_t s = 0; s < start_.spring_count(); ++s) {
    const double factor = std::exp(theta[s]);
    model.stiffness[s] *= factor;
    model.damping[s] *= factor;
  }
  for (std::uint32_t t = 0; t < start_.dilatation.count(); ++t)
    model.dilatation.modulus[t] *= std::exp(kTermScale * theta[springs() + t]);
  return model;
}

MassSpringModel LevelVariables::model(const Eigen::VectorXd& theta) const {
  MassSpringModel model = with_stiffness(theta);
  for (Eigen::Index i = 0; i < masses(); ++i)
    model.mass[static_cast<std::size_t>(i)] *=
        std::exp(kMassScale * theta[springs() + terms() + i]);
  if (moments_) moments_->restore(model.mass);
  return model;
}

MassSpringModel LevelVariables::model(const FitPoint& point) const {
  MassSpringModel model = with_stiffness(point.theta);
  model.mass = point.mass;
  return model;
}

void LevelVariables::masses_to_theta(const std::vector<double>& mass,
                                     Eigen::VectorXd& theta) const {
  for (Eigen::Index i = 0; i < masses(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    theta[springs() + terms() + i] = std::log(mass[node] / start_.mass[node]) / kMassScale;
  }
}

void LevelVariables::project_jacobian(const std::vector<double>& mass,
                                      Eigen::MatrixXd& jacobian) const {
  jacobian.middleRows(springs(), terms()) *= kTermScale;
  if (!moments_) return;
  auto by_mass = jacobian.bottomRows(masses());
  by_mass *= kMassScale;
  moments_->project(mass, by_mass);
}

Eigen::SparseMatrix<double, Eigen::RowMajor> LevelVariables::scaled_jacobian(
    Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian) const {
  if (terms() == 0 && masses() == 0) return jacobian;
  Eigen::VectorXd scale = Eigen::VectorXd::Ones(count());
  scale.segment(springs(), terms()).setConstant(kTermScale);
  scale.tail(masses()).setConstant(kMassScale);
  return jacobian * scale.asDiagonal();
}

}  // namespace springlod::lod
