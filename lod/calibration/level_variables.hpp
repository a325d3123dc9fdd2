#pragma once

#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "lod/calibration/mass_moments.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// A level on its way, beside what it started from.
struct FitPoint {
  Eigen::VectorXd theta;     ///< S + N, see LevelVariables
  std::vector<double> mass;  ///< N [kg]: what theta says, to the last bit
};

/// What a fit changes of a level: theta = changes of ln k of each spring, S, then of ln m of each
/// node, N, in units of one half, as masses are better known. Damping keeps its part of stiffness,
/// the masses the moments that are to be kept. Refers to the level, which must outlive it.
class LevelVariables {
 public:
  LevelVariables(const MassSpringModel& start, KeptMoments kept)
      : start_(start), moments_(start, kept) {}

  Eigen::Index springs() const { return start_.spring_count(); }
  Eigen::Index nodes() const { return start_.node_count(); }
  Eigen::Index count() const { return springs() + nodes(); }

  /// The level changed by theta, with its moments of mass restored.
  MassSpringModel model(const Eigen::VectorXd& theta) const;
  MassSpringModel model(const FitPoint& point) const;
  /// Brings the part of the masses in theta to what they are once moments are restored.
  void masses_to_theta(const std::vector<double>& mass, Eigen::VectorXd& theta) const;

  /// From slopes by ln k and ln m, a row each, to slopes by theta along what keeps the moments.
  void project_jacobian(const std::vector<double>& mass, Eigen::MatrixXd& jacobian) const;
  /// From slopes by ln k and ln m, a column each, to slopes by theta.
  Eigen::SparseMatrix<double, Eigen::RowMajor> scaled_jacobian(
      const Eigen::SparseMatrix<double, Eigen::RowMajor>& jacobian) const;

 private:
  MassSpringModel with_springs(const Eigen::VectorXd& theta) const;

  const MassSpringModel& start_;
  MassMoments moments_;
};

}  // namespace springlod::lod
