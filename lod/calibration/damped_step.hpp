#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace springlod::lod {

/// G^T G with its factors for the last damping: the steps from one point, whose constraints differ,
/// mostly have the same.
class DampedNormal {
 public:
  explicit DampedNormal(const Eigen::MatrixXd& normal)  ///< must outlive this
      : normal_(&normal), scale_(normal.diagonal().mean()) {}

  /// Mean diagonal.
  double scale() const { return scale_; }
  /// Factors of G^T G + epsilon I.
  const Eigen::LLT<Eigen::MatrixXd>& factors(double epsilon);

 private:
  const Eigen::MatrixXd* normal_;
  double scale_;
  double epsilon_ = -1;  // of the factors; none yet if negative
  Eigen::LLT<Eigen::MatrixXd> factors_;
};

/// Linearized least-squares problem with penalized constraints (docs/method.md, eqs. 40 and 41):
///   min_d |G^T d - r|^2 + w^2 sum over active i of (h_i + H_i d)^2 + epsilon |d|^2.
/// A constraint is active if it is violated at `linearized_at`.
struct StepProblem {
  const Eigen::MatrixXd& jacobian;  ///< G = -dr/dtheta: n x R, dense, R much less than n
  DampedNormal& normal;             ///< G^T G
  const Eigen::VectorXd& residual;  ///< r, R
  const Eigen::SparseMatrix<double, Eigen::RowMajor>&
      constraint_jacobian;                  ///< H = dh/dtheta: L x n, sparse
  const Eigen::VectorXd& constraint_value;  ///< h, L, extrapolated to d = 0
  Eigen::VectorXd linearized_at{};          ///< d at which h was linearized, n; empty: 0
  double constraint_weight = 1;             ///< w
  double most_rms = 0.2;                    ///< bound on the root mean square of d
};

/// Levenberg-Marquardt step d, n (Levenberg 1944, Marquardt 1963). `damping` is epsilon over the
/// mean diagonal of G^T G [1]; it is increased until the root mean square of d is at most
/// `most_rms`, and holds the increased value on return.
Eigen::VectorXd damped_step(const StepProblem& problem, double& damping);

}  // namespace springlod::lod
