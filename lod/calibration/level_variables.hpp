#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "lod/calibration/mass_moments.hpp"
#include "lod/options.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// A level during its fit, relative to the level before it.
struct FitPoint {
  Eigen::VectorXd theta;     ///< see LevelVariables
  std::vector<double> mass;  ///< N [kg], those of theta; stored because exp(theta) rounds
};

/// Unknowns theta of a fit: the change of ln k of each spring, S; then that of ln |T| of each
/// dilatation term, T, in units of 0.2; with NodeMasses::free then that of ln m of each node, N, in
/// units of 0.5 (docs/method.md, eq. 29). The units penalize changes of terms and masses more than
/// changes of stiffness. c / k of each spring, the sign of each term and the moments of mass are
/// kept; with NodeMasses::group each mass is, to the bit. Refers to the level, which must outlive
/// it.
class LevelVariables {
 public:
  LevelVariables(const MassSpringModel& start, const FitOptions& options);

  Eigen::Index springs() const { return start_.spring_count(); }
  Eigen::Index terms() const { return start_.dilatation.count(); }
  Eigen::Index masses() const { return moments_ ? start_.node_count() : 0; }
  Eigen::Index count() const { return springs() + terms() + masses(); }

  /// The level at theta, with its moments of mass restored.
  MassSpringModel model(const Eigen::VectorXd& theta) const;
  MassSpringModel model(const FitPoint& point) const;
  /// Sets the mass unknowns of theta from `mass`, N [kg].
  void masses_to_theta(const std::vector<double>& mass, Eigen::VectorXd& theta) const;

  /// Turns derivatives by the logarithms, count() rows, into derivatives by theta, projected onto
  /// the changes that keep the moments of `mass` to first order (docs/method.md, eq. 35).
  void project_jacobian(const std::vector<double>& mass, Eigen::MatrixXd& jacobian) const;
  /// Turns derivatives by the logarithms, count() columns, into derivatives by theta.
  Eigen::SparseMatrix<double, Eigen::RowMajor> scaled_jacobian(
      Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian) const;

 private:
  MassSpringModel with_stiffness(const Eigen::VectorXd& theta) const;

  const MassSpringModel& start_;
  std::optional<MassMoments> moments_;  // with NodeMasses::free
};

}  // namespace springlod::lod
