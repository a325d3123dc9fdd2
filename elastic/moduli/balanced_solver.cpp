#include "elastic/moduli/balanced_solver.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::elastic {

BalancedSolver::BalancedSolver(const Matrix& stiffness, BalancedSolverOptions options)
    : options_(std::move(options)), solver_(stiffness) {
  solver_.setTolerance(options_.tolerance);
  solver_.setMaxIterations(options_.most_steps);
}

Eigen::VectorXd BalancedSolver::solve(const Eigen::VectorXd& force) const {
  Eigen::VectorXd moved = solver_.solve(force);
  if (solver_.info() != Eigen::Success)
    throw InputError(fmt::format("{}: not solved after {} steps (residual {:.1e}){}{}",
                                 options_.name, solver_.iterations(), solver_.error(),
                                 options_.advice.empty() ? "" : "; ", options_.advice));
  return moved;
}

}  // namespace springlod::elastic
