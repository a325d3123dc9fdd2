#pragma once

#include <utility>

#include <Eigen/Core>

namespace springlod::elastic {

struct ConjugateGradientSolution {
  Eigen::MatrixXd x;
  Eigen::VectorXd last_step;  ///< squared norm of the last update of each column; 0 once exact
};

/// Preconditioned conjugate gradients (Hestenes & Stiefel 1952) for A X = B, A symmetric positive
/// semidefinite. Each column has its own step lengths; A and the preconditioner M are applied to
/// all columns at once, so that a sparse factor is read once per step and not once per column.
///
///   apply(P)         A P
///   precondition(R)  M^-1 R
///   first_direction  M^-1 B, which the caller may know already
///   converged(column, solution, residual)
///
/// Stops when all columns have converged, or after `most_steps`. A column whose residual is
/// rounding takes no further steps: they would follow the rounding, and grow without bound where A
/// is singular.
template <class Apply, class Precondition, class Converged>
ConjugateGradientSolution conjugate_gradients(const Eigen::MatrixXd& right,
                                              Eigen::MatrixXd first_direction, int most_steps,
                                              const Apply& apply, const Precondition& precondition,
                                              const Converged& converged) {
  ConjugateGradientSolution solution{Eigen::MatrixXd::Zero(right.rows(), right.cols()),
                                     Eigen::VectorXd::Zero(right.cols())};
  Eigen::MatrixXd direction = std::move(first_direction);
  Eigen::MatrixXd residual = right;
  Eigen::VectorXd work = residual.cwiseProduct(direction).colwise().sum();
  constexpr double kRounding = 1e-14;  // of a residual, relative to the right side
  const Eigen::VectorXd exact = kRounding * right.colwise().norm();
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::MatrixXd product = apply(direction);
    bool done = true;
    for (Eigen::Index c = 0; c < right.cols(); ++c) {
      if (residual.col(c).norm() <= exact[c]) {
        solution.last_step[c] = 0;
        continue;
      }
      const double energy = direction.col(c).dot(product.col(c));
      const double length = energy > 0 ? work[c] / energy : 0;
      solution.last_step[c] = length * length * direction.col(c).squaredNorm();
      solution.x.col(c) += length * direction.col(c);
      residual.col(c) -= length * product.col(c);
      done = converged(c, solution, residual) && done;
    }
    if (done) break;
    const Eigen::MatrixXd preconditioned = precondition(residual);
    const Eigen::VectorXd next = residual.cwiseProduct(preconditioned).colwise().sum();
    for (Eigen::Index c = 0; c < right.cols(); ++c)
      direction.col(c) =
          preconditioned.col(c) + (work[c] > 0 ? next[c] / work[c] : 0) * direction.col(c);
    work = next;
  }
  return solution;
}

}  // namespace springlod::elastic
