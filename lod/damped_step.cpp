#include "lod/damped_step.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Cholesky>

#include "model/dense_kernels.hpp"

namespace springlod {
namespace {

/// How often limits that a step would break are added; what then still breaks is left to the next
/// step.
constexpr int kPasses = 3;
/// By what the damping grows while the step is too long.
constexpr double kRaise = 3;
/// Limits hardly couple (neighbours share one of a dozen springs), so that a few iterations do.
constexpr double kAccuracy = 1e-6;
constexpr int kMostIterations = 200;

using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
/// What belongs to a limit lies together.
using RowBlock = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (A + shift I) x = b for all columns at once by conjugate gradients, each by itself, going on
/// from the x given.
void solve_columns(const Rows& a, double shift, const RowBlock& b, RowBlock& x) {
  const auto product = [&](const RowBlock& y) -> RowBlock { return a * y + shift * y; };
  using Each = Eigen::Array<double, 1, Eigen::Dynamic>;
  const Each small = kAccuracy * kAccuracy * b.colwise().squaredNorm().array();
  RowBlock rest = b - product(x);
  RowBlock direction = rest;
  Each size = rest.colwise().squaredNorm();
  for (int i = 0; i < kMostIterations && (size > small).any(); ++i) {
    const RowBlock image = product(direction);
    const Each energy = direction.cwiseProduct(image).colwise().sum();
    const Each length = (energy > 0).select(size / energy, 0);
    x += direction * length.matrix().asDiagonal();
    rest -= image * length.matrix().asDiagonal();
    const Each next = rest.colwise().squaredNorm();
    const Each part = (size > 0).select(next / size, 0);
    direction = rest + direction * part.matrix().asDiagonal();
    size = next;
  }
}

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
  ActiveStep(const StepProblem& problem, const std::vector<Eigen::Index>& active)
      : problem_(problem),
        limits_(problem.limit_weight * chosen(problem.limits, active)),
        product_(limits_ * Rows(limits_.transpose())),
        right_(limits_.rows(), problem.miss.size() + 1),
        eliminated_(RowBlock::Zero(right_.rows(), right_.cols())) {
    right_.leftCols(problem.miss.size()) = limits_ * problem.slopes;
    for (Eigen::Index r = 0; r < right_.rows(); ++r)
      right_(r, problem.miss.size()) =
          -problem.limit_weight * problem.excess[active[static_cast<std::size_t>(r)]];
  }

  Eigen::VectorXd solve(double damping) {
    Eigen::MatrixXd schur = problem_.normal;
    schur.diagonal().array() += damping;
    if (right_.rows() == 0) return problem_.slopes * schur.ldlt().solve(problem_.miss);
    solve_columns(product_, damping, right_, eliminated_);
    const Eigen::Index rows = problem_.miss.size();
    // The coupling w H J stands in the first columns, -w excess in the last.
    const Eigen::MatrixXd reduced = transposed_product(right_.leftCols(rows), eliminated_);
    schur -= reduced.leftCols(rows);
    const Eigen::VectorXd y = schur.ldlt().solve(problem_.miss - reduced.col(rows));
    const Eigen::VectorXd z = eliminated_.col(rows) - eliminated_.leftCols(rows) * y;
    return problem_.slopes * y + limits_.transpose() * z;
  }

 private:
  const StepProblem& problem_;
  Rows limits_;          // w H of the active ones
  Rows product_;         // w^2 H H^T
  RowBlock right_;       // [w H J, -w excess]
  RowBlock eliminated_;  // (product + damping)^-1 of it, of the last damping
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
    ActiveStep step(problem, active);
    d = step.solve(damping * scale);
    for (; rms(d) > problem.most_rms; d = step.solve(damping * scale)) damping *= kRaise;
    const Eigen::VectorXd after = problem.excess + problem.limits * d;
    const bool more = ((after.array() > 0) && (over.array() <= 0)).any();
    over = over.cwiseMax(after);
    if (!more) break;
  }
  return d;
}

}  // namespace springlod
