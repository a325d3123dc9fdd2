#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace springlod::lod {

/// The step d of least |d| that makes up for misses, damped (Levenberg 1944):
///   min |J^T d - miss|^2 + sum over the active limits of w^2 (H d + excess)^2 + damping |d|^2.
/// A limit is active if it is above 0 at `near`, or would be after the step.
struct StepProblem {
  const Eigen::MatrixXd& jacobian;  ///< J: n x R, dense, R few
  const Eigen::MatrixXd& normal;    ///< J^T J
  const Eigen::VectorXd& residual;  ///< R
  const Eigen::SparseMatrix<double, Eigen::RowMajor>&
      constraint_jacobian;                  ///< H: L x n, L may be many
  const Eigen::VectorXd& constraint_value;  ///< L, at d = 0
  Eigen::VectorXd linearized_at{};          ///< n, none: 0
  double constraint_weight = 1;             ///< w
  double most_rms = 0.2;                    ///< of d: the damping is raised until it holds
};

/// `damping` is relative to the mean of J's columns' squared norms; it comes back as it was raised.
Eigen::VectorXd damped_step(const StepProblem& problem, double& damping);

}  // namespace springlod::lod
