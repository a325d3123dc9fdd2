#include "lod/damped_step.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/IterativeLinearSolvers>

namespace springlod {
namespace {

/// How often limits that a step would break are added; what then still breaks is left to the next
/// step.
constexpr int kPasses = 3;
/// By what the damping grows while the step is too long.
constexpr double kRaise = 3;
/// Limits hardly couple (neighbours share one of a dozen springs), so that a few iterations do.
constexpr double kAccuracy = 1e-8;

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;

Rows chosen(const Rows& all, const std::vector<Eigen::Index>& active) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t r = 0; r < active.size(); ++r)
    for (Rows::InnerIterator it(all, active[r]); it; ++it)
      entries.emplace_back(static_cast<int>(r), static_cast<int>(it.col()), it.value());
  Rows rows(static_cast<Eigen::Index>(active.size()), all.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

/// Solves for fixed active limits: with B = [J^T; w H] the step is B^T (B B^T + a I)^-1 [miss; -w
/// excess], the limits eliminated first as there may be many and they are sparse.
class ActiveStep {
 public:
  ActiveStep(const StepProblem& problem, const Eigen::MatrixXd& normal,
             const std::vector<Eigen::Index>& active)
      : problem_(problem),
        normal_(normal),
        limits_(problem.limit_weight * chosen(problem.limits, active)),
        coupling_(limits_ * problem.slopes),
        product_(limits_ * Rows(limits_.transpose())),
        over_(static_cast<Eigen::Index>(active.size())) {
    for (Eigen::Index r = 0; r < over_.size(); ++r)
      over_[r] = -problem.limit_weight * problem.excess[active[static_cast<std::size_t>(r)]];
  }

  Eigen::VectorXd solve(double damping) const {
    Eigen::MatrixXd schur = normal_;
    schur.diagonal().array() += damping;
    if (over_.size() == 0) return problem_.slopes * schur.ldlt().solve(problem_.miss);
    Eigen::SparseMatrix<double> damped = product_;
    for (Eigen::Index r = 0; r < over_.size(); ++r) damped.coeffRef(r, r) += damping;
    Eigen::ConjugateGradient<Eigen::SparseMatrix<double>, Eigen::Lower | Eigen::Upper> inverse;
    inverse.setTolerance(kAccuracy);
    inverse.compute(damped);
    const Eigen::MatrixXd eliminated = inverse.solve(coupling_);
    const Eigen::VectorXd alone = inverse.solve(over_);
    schur.noalias() -= coupling_.transpose() * eliminated;
    const Eigen::VectorXd y = schur.ldlt().solve(problem_.miss - coupling_.transpose() * alone);
    const Eigen::VectorXd z = alone - eliminated * y;
    return problem_.slopes * y + limits_.transpose() * z;
  }

 private:
  const StepProblem& problem_;
  const Eigen::MatrixXd& normal_;  // J^T J
  Rows limits_;                    // w H of the active ones
  Eigen::MatrixXd coupling_;       // w H J
  Rows product_;                   // w^2 H H^T
  Eigen::VectorXd over_;           // -w excess
};

double rms(const Eigen::VectorXd& d) {
  return std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
}

}  // namespace

Eigen::VectorXd damped_step(const StepProblem& problem, double& damping) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(problem.miss.size(), problem.miss.size());
  normal.selfadjointView<Eigen::Lower>().rankUpdate(problem.slopes.transpose());
  normal = normal.selfadjointView<Eigen::Lower>();
  const double scale = normal.diagonal().mean();

  Eigen::VectorXd after = problem.excess;
  Eigen::VectorXd d;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index r = 0; r < after.size(); ++r)
      if (problem.excess[r] > 0 || after[r] > 0) active.push_back(r);
    const ActiveStep step(problem, normal, active);
    d = step.solve(damping * scale);
    for (; rms(d) > problem.most_rms; d = step.solve(damping * scale)) damping *= kRaise;
    const Eigen::VectorXd next = problem.excess + problem.limits * d;
    const bool more =
        ((next.array() > 0) && (after.array() <= 0) && (problem.excess.array() <= 0)).any();
    after = after.cwiseMax(next);
    if (!more) break;
  }
  return d;
}

}  // namespace springlod
