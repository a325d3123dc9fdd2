#include "lod/calibration/constrained_step.hpp"

#include <optional>
#include <utility>

#include "lod/calibration/damped_step.hpp"
#include "lod/calibration/frequency_constraints.hpp"

namespace springlod::lod {
namespace {

/// Bounds on each component of a step and on its root mean square.
constexpr double kMostStep = 1, kMostRms = 0.15;
/// Nodes with ln(squared frequency / bound) below -kMargin have no constraint row.
constexpr double kMargin = 1;
/// Linearizations of the constraints per step. The constraints are strongly nonlinear and cheap;
/// the residuals are nearly linear and costly, so they are linearized once (docs/method.md, eq.
/// 42a).
constexpr int kLinearizations = 4;
/// Least part of a linearized step that is tried, after all, half and a quarter of it. Without the
/// search the steps would jump from one side of the constraints to the other.
constexpr double kLeastPart = 0.125;
/// A linearization that lowers F by less than this fraction is the last.
constexpr double kWorthwhile = 1e-3;

/// A step d with what F consists of there.
struct Trial {
  Eigen::VectorXd change;
  Eigen::VectorXd remainder;  // r - G^T d
  double violation = 0;       // chi^2 sum_i max(0, h_i)^2
};

class StepSearch {
 public:
  StepSearch(const ConstrainedProblem& problem, double& damping)
      : problem_(problem), normal_(problem.normal), damping_(damping) {}

  ConstrainedStep run() {
    const Eigen::Index unknowns = problem_.variables.count();
    Trial best{Eigen::VectorXd::Zero(unknowns), problem_.residual, 0};
    best.violation = violation(best.change);
    const double before = objective(best);
    for (int i = 0; i < kLinearizations; ++i) {
      const Eigen::VectorXd target = linearized(best.change);
      if (!target.allFinite()) break;
      const double value = damped(best);  // with the damping of this step
      std::optional<Trial> better = search(best, target, value);
      if (!better) break;
      best = *std::move(better);
      if (value - damped(best) < kWorthwhile * value) break;
    }
    return {std::move(best.change), before - objective(best)};
  }

 private:
  double violation(const Eigen::VectorXd& change) const {
    const double chi = problem_.constraint_weight;
    return chi * chi *
           squared_violation(problem_.variables.model(problem_.theta + change), problem_.bound);
  }
  double objective(const Trial& trial) const {
    return trial.remainder.squaredNorm() + trial.violation;
  }
  double damped(const Trial& trial) const {
    return objective(trial) + damping_ * normal_.scale() * trial.change.squaredNorm();
  }

  /// Step with the constraints linearized at the step `at`.
  Eigen::VectorXd linearized(const Eigen::VectorXd& at) {
    const FrequencyConstraints constraints = frequency_constraints(
        problem_.variables.model(problem_.theta + at), problem_.bound, kMargin, problem_.masses);
    const Eigen::SparseMatrix<double, Eigen::RowMajor> by_theta =
        problem_.variables.scaled_jacobian(constraints.jacobian);
    const Eigen::VectorXd value = constraints.value - by_theta * at;
    return damped_step({.jacobian = problem_.jacobian,
                        .normal = normal_,
                        .residual = problem_.residual,
                        .constraint_jacobian = by_theta,
                        .constraint_value = value,
                        .linearized_at = at,
                        .constraint_weight = problem_.constraint_weight,
                        .most_rms = kMostRms},
                       damping_)
        .cwiseMax(-kMostStep)
        .cwiseMin(kMostStep);
  }

  /// The longest part of the way from `from` to `target` that lowers the damped objective below
  /// `value`.
  std::optional<Trial> search(const Trial& from, const Eigen::VectorXd& target,
                              double value) const {
    const Eigen::VectorXd way = target - from.change;
    const Eigen::VectorXd gain = problem_.jacobian.transpose() * way;
    for (double part = 1; part >= kLeastPart; part /= 2) {
      Trial trial{from.change + part * way, from.remainder - part * gain, 0};
      trial.violation = violation(trial.change);
      if (damped(trial) < value) return trial;
    }
    return std::nullopt;
  }

  const ConstrainedProblem& problem_;
  DampedNormal normal_;
  double& damping_;
};

}  // namespace

ConstrainedStep constrained_step(const ConstrainedProblem& problem, double& damping) {
  return StepSearch(problem, damping).run();
}

}  // namespace springlod::lod
