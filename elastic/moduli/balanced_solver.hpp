#pragma once

#include <string>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>

namespace springlod::elastic {

struct BalancedSolverOptions {
  std::string name;         ///< of the test, for messages
  std::string advice = {};  ///< what to do if it does not converge, for messages
  double tolerance = 1e-7;  ///< relative residual
  Eigen::Index most_steps = 20000;
};

/// Solves K u = f by conjugate gradients for the stiffness matrix of an unsupported body. K is
/// singular, but the forces must balance: iterates from zero then stay free of rigid motions.
class BalancedSolver {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  /// Refers to the matrix, which must outlive it.
  BalancedSolver(const Matrix& stiffness, BalancedSolverOptions options);
  /// Throws InputError if the tolerance is not reached.
  Eigen::VectorXd solve(const Eigen::VectorXd& force) const;

 private:
  BalancedSolverOptions options_;
  Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper> solver_;
};

}  // namespace springlod::elastic
