#include "lod/calibration/damped_step.hpp"

#include <cmath>
#include <vector>

#include "elastic/solver/conjugate_gradients.hpp"

namespace springlod::lod {
namespace {

/// Factor on the damping while the step is too long.
constexpr double kRaise = 3;
/// Relative accuracy and largest number of iterations of the conjugate gradients. They solve for
/// the constraints alone; the residuals are eliminated exactly. The constraints are nonlinear, and
/// their linearization error exceeds what the last iterations would gain.
constexpr double kAccuracy = 1e-7;
constexpr int kMostIterations = 60;

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Rows select_rows(const Rows& all, const std::vector<Eigen::Index>& active) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < active.size(); ++r)
    for (Rows::InnerIterator it(all, active[r]); it; ++it)
      entries.emplace_back(static_cast<int>(r), static_cast<int>(it.col()), it.value());
  Rows rows(static_cast<Eigen::Index>(active.size()), all.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

/// Solution for a fixed active set: with B = [G^T; w H] the step is B^T x, where
///   (B B^T + epsilon I) x = [r; -w h].
/// The dense rows are eliminated; the Schur complement of the constraints, unknowns z, is solved by
/// conjugate gradients.
class ActiveStep {
 public:
  ActiveStep(const StepProblem& problem, const std::vector<Eigen::Index>& active)
      : problem_(problem),
        constraints_(problem.constraint_weight * select_rows(problem.constraint_jacobian, active)),
        product_(constraints_ * Rows(constraints_.transpose())),
        coupling_(constraints_ * problem.jacobian),
        right_(constraints_.rows()) {
    for (Eigen::Index r = 0; r < right_.size(); ++r)
      right_[r] = -problem.constraint_weight *
                  problem.constraint_value[active[static_cast<std::size_t>(r)]];
  }

  Eigen::VectorXd solve(double damping) const {
    const Eigen::LLT<Eigen::MatrixXd>& dense = problem_.normal.factors(damping);
    if (right_.size() == 0) return problem_.jacobian * dense.solve(problem_.residual);
    const Eigen::VectorXd z =
        solve_constraints(dense, damping, right_ - coupling_ * dense.solve(problem_.residual));
    const Eigen::VectorXd y = dense.solve(problem_.residual - coupling_.transpose() * z);
    return problem_.jacobian * y + constraints_.transpose() * z;
  }

 private:
  /// Solves (product + damping I - coupling dense^-1 coupling^T) z = right, preconditioned by the
  /// diagonal without the last term. With the term it would need a tenth fewer iterations, but an
  /// elimination for every constraint.
  Eigen::VectorXd solve_constraints(const Eigen::LLT<Eigen::MatrixXd>& dense, double damping,
                                    const Eigen::VectorXd& right) const {
    const Eigen::VectorXd scale = (product_.diagonal().array() + damping).inverse();
    const Eigen::VectorXd first = scale.cwiseProduct(right);
    const double small = kAccuracy * kAccuracy * right.dot(first);
    return elastic::conjugate_gradients(
               right, first, kMostIterations,
               [&](const Eigen::VectorXd& direction) {
                 Eigen::VectorXd image = product_ * direction + damping * direction;
                 image.noalias() -= coupling_ * dense.solve(coupling_.transpose() * direction);
                 return image;
               },
               [&](const Eigen::MatrixXd& residual) { return scale.cwiseProduct(residual); },
               [&](Eigen::Index, const elastic::ConjugateGradientSolution&,
                   const Eigen::MatrixXd& residual) {
                 return residual.col(0).dot(scale.cwiseProduct(residual.col(0))) <= small;
               })
        .x;
  }

  const StepProblem& problem_;
  Rows constraints_;          // w H of the active set
  Rows product_;              // w^2 H H^T
  Eigen::MatrixXd coupling_;  // w H G
  Eigen::VectorXd right_;     // -w h
};

double rms(const Eigen::VectorXd& d) {
  return std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
}

}  // namespace

const Eigen::LLT<Eigen::MatrixXd>& DampedNormal::factors(double epsilon) {
  if (epsilon != epsilon_) {
    Eigen::MatrixXd damped = *normal_;
    damped.diagonal().array() += epsilon;
    factors_.compute(damped);
    epsilon_ = epsilon;
  }
  return factors_;
}

Eigen::VectorXd damped_step(const StepProblem& problem, double& damping) {
  const double scale = problem.normal.scale();
  Eigen::VectorXd violation = problem.constraint_value;
  if (problem.linearized_at.size() > 0)
    violation += problem.constraint_jacobian * problem.linearized_at;
  std::vector<Eigen::Index> active;
  for (Eigen::Index r = 0; r < violation.size(); ++r)
    if (violation[r] > 0) active.push_back(r);
  const ActiveStep step(problem, active);
  Eigen::VectorXd d = step.solve(damping * scale);
  for (; rms(d) > problem.most_rms; d = step.solve(damping * scale)) damping *= kRaise;
  return d;
}

}  // namespace springlod::lod
