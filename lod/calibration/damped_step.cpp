#include "lod/calibration/damped_step.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "elastic/solver/conjugate_gradients.hpp"
#include "elastic/solver/dense_kernels.hpp"

namespace springlod::lod {
namespace {

/// How often limits that a step would break are added; what then still breaks is left to the next
/// step.
constexpr int kPasses = 3;
/// By what the damping grows while the step is too long.
constexpr double kRaise = 3;
/// How well the limits' part of a step is solved for, and after how many iterations what there is
/// will do: misses are made up for exactly all the same, and limits bend more than is left then.
constexpr double kAccuracy = 1e-7;
constexpr int kMostIterations = 60;

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

/// Solves for fixed active limits: with B = [J^T; w H] the step is B^T x of
///   (B B^T + a I) x = [miss; -w excess],
/// the dense rows eliminated first, the limits' part z solved for by conjugate gradients.
class ActiveStep {
 public:
  ActiveStep(const StepProblem& problem, const std::vector<Eigen::Index>& active)
      : problem_(problem),
        limits_(problem.limit_weight * chosen(problem.limits, active)),
        product_(limits_ * Rows(limits_.transpose())),
        coupling_(limits_ * problem.slopes),
        over_(limits_.rows()) {
    for (Eigen::Index r = 0; r < over_.size(); ++r)
      over_[r] = -problem.limit_weight * problem.excess[active[static_cast<std::size_t>(r)]];
  }

  Eigen::VectorXd solve(double damping) const {
    Eigen::MatrixXd normal = problem_.normal;
    normal.diagonal().array() += damping;
    const Eigen::LLT<Eigen::MatrixXd> dense(normal);
    if (over_.size() == 0) return problem_.slopes * dense.solve(problem_.miss);
    Eigen::MatrixXd along = coupling_;  // w H J L^-T, L L^T = J^T J + a I
    elastic::solve_right_transposed(dense.matrixLLT(), along);
    const Eigen::VectorXd z =
        solve_limits(along, damping, over_ - along * dense.matrixL().solve(problem_.miss));
    const Eigen::VectorXd y = dense.solve(problem_.miss - coupling_.transpose() * z);
    return problem_.slopes * y + limits_.transpose() * z;
  }

 private:
  /// (product + damping I - along along^T) z = right.
  Eigen::VectorXd solve_limits(const Eigen::MatrixXd& along, double damping,
                               const Eigen::VectorXd& right) const {
    const Eigen::VectorXd scale =
        (product_.diagonal().array() + damping - along.rowwise().squaredNorm().array()).inverse();
    const Eigen::VectorXd first = scale.cwiseProduct(right);
    const double small = kAccuracy * kAccuracy * right.dot(first);
    return elastic::conjugate_gradients(
               right, first, kMostIterations,
               [&](const Eigen::VectorXd& direction) {
                 Eigen::VectorXd image = product_ * direction + damping * direction;
                 image.noalias() -= along * (along.transpose() * direction).eval();
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
  Rows limits_;               // w H of the active ones
  Rows product_;              // w^2 H H^T
  Eigen::MatrixXd coupling_;  // w H J
  Eigen::VectorXd over_;      // -w excess
};

double rms(const Eigen::VectorXd& d) {
  return std::sqrt(d.squaredNorm() / static_cast<double>(d.size()));
}

}  // namespace

Eigen::VectorXd damped_step(const StepProblem& problem, double& damping) {
  const double scale = problem.normal.diagonal().mean();
  Eigen::VectorXd over = problem.excess;
  if (problem.near.size() > 0) over += problem.limits * problem.near;
  Eigen::VectorXd d;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::vector<Eigen::Index> active;
    for (Eigen::Index r = 0; r < over.size(); ++r)
      if (over[r] > 0) active.push_back(r);
    const ActiveStep step(problem, active);
    d = step.solve(damping * scale);
    for (; rms(d) > problem.most_rms; d = step.solve(damping * scale)) damping *= kRaise;
    const Eigen::VectorXd after = problem.excess + problem.limits * d;
    const bool more = ((after.array() > 0) && (over.array() <= 0)).any();
    over = over.cwiseMax(after);
    if (!more) break;
  }
  return d;
}

}  // namespace springlod::lod
