#include "lod/calibration/fit_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/stable_step.hpp"
#include "lod/calibration/damped_step.hpp"
#include "lod/calibration/elastic_fit.hpp"
#include "lod/calibration/frequency_constraints.hpp"
#include "lod/calibration/tolerance.hpp"

namespace springlod::lod {
namespace {

/// Bounds on each component of a step, on its root mean square, and on each component of theta.
constexpr double kMostStep = 1, kMostRms = 0.15, kMostChange = 3;
/// Damping relative to the mean diagonal of G^T G: initial value, least and largest.
constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-5, kMostDamping = 1e6;
/// Divisor of the damping after an accepted step, unless the step before was rejected, and factor
/// on it after a rejected step.
constexpr double kDampingDecrease = 3, kDampingIncrease = 4;
/// Penalty weight of a constraint, relative to a smooth load. In a level of more than 1000 nodes
/// the constraints weigh as much as those of 1000 nodes; they would outweigh the residuals
/// otherwise (docs/method.md, eq. 39).
constexpr double kConstraintWeight = 0.5, kConstraintNodes = 1000;
/// Linearizations of the constraints per step. The constraints are strongly nonlinear and cheap;
/// the residuals are nearly linear and costly, so they are linearized once (docs/method.md, eq.
/// 42).
constexpr int kRelinearizations = 4;
/// Factor on the frequency bound each time the level is within tolerance (docs/method.md, eq. 45).
/// If the level stays outside tolerance for kPatience steps, the factor becomes its own square
/// root; the fit ends when the factor exceeds kLeastTighten.
constexpr double kTighten = 0.8, kLeastTighten = 0.98;
constexpr std::uint32_t kPatience = 10;
/// A level that was never within tolerance counts as improving while its merit falls by a factor of
/// kImprovement within kStalled steps. If it does not, the tolerances that it exceeds become its
/// errors times kSlack.
constexpr double kImprovement = 0.9, kSlack = 1.1;
constexpr std::uint32_t kStalled = 5;
/// Least ratio of the frequency bound to the largest squared node frequency. With a smaller ratio
/// nearly all nodes would be constrained instead of the stiffest.
constexpr double kLeastBound = 0.68;
/// Nodes with ln(squared frequency / bound) below -kMargin have no constraint row.
constexpr double kMargin = 1;

/// Tolerances of patch and piece loads, and of region loads, relative to that of the ten lowest
/// frequencies (docs/method.md, eq. 44).
constexpr double kPatchLoadsTolerance = 8, kRegionLoadsTolerance = 8;

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  end = std::min(end, values.size());
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return end > begin ? sum / static_cast<double>(end - begin) : 0;
}

class PartFit {
 public:
  PartFit(const MassSpringModel& level, const Groups& of_base, const ElasticTargets& targets,
          const FitOptions& options, const FitProgress& progress)
      : start_(level),
        targets_(targets),
        progress_(progress),
        masses_(options.masses),
        steps_(fit_steps(options, level.node_count())),
        tolerance_(frequency_tolerance(options.tolerance, targets.nodes, level.node_count())),
        least_frequency_(options.least_frequency * targets.highest_frequency *
                         std::cbrt(static_cast<double>(level.node_count()) / targets.nodes)),
        constraint_weight_(kConstraintWeight *
                           std::sqrt(std::min(1.0, kConstraintNodes / level.node_count()))),
        variables_(level, options),
        fit_(level, of_base, targets, options) {}

  MassSpringModel run() {
    if (progress_.from)
      restore(*progress_.from);
    else
      begin();
    for (; !finished_ && iteration_ < steps_; report()) {
      if (!best_) give_slack_if_stalled();
      if (within_tolerance(now_)) {
        keep_if_better();
        if (best_->highest_frequency <= least_frequency_) break;
        const double largest = largest_node_bound(now_.model);
        bound_ = std::max(tighten_ * std::min(bound_, largest), kLeastBound * largest);
        steps_outside_ = 0;
      } else if (best_ && (steps_outside_ >= kPatience || damping_ > kMostDamping)) {
        if (!back_off()) break;
        steps_outside_ = 0;
      }
      ++steps_outside_;
      ++iteration_;
      if (!advance() && !best_) break;
    }
    if (!finished_) {
      if (within_tolerance(now_)) keep_if_better();
      finished_ = true;
      report();
    }
    return best_ ? std::move(best_->model) : std::move(now_.model);
  }

 private:
  struct Point {
    Eigen::VectorXd theta;
    MassSpringModel model;
    ElasticResiduals residuals;
  };
  /// Derivatives of the residuals at now_, the only point that steps start from.
  struct Linearized {
    Eigen::MatrixXd jacobian;  // G by theta, projected: see project_jacobian
    Eigen::MatrixXd normal;    // G^T G
  };
  using Ratios = decltype(FitState::slack);
  struct Best {
    Eigen::VectorXd theta;
    MassSpringModel model;
    double highest_frequency = 0;
  };

  void begin() {
    start_from(at(Eigen::VectorXd::Zero(variables_.count())));
    bound_ = largest_node_bound(start_);
  }

  void restore(const FitState& state) {
    iteration_ = state.iteration;
    steps_outside_ = state.steps_outside;
    finished_ = state.finished;
    bound_ = state.bound;
    damping_ = state.damping;
    rejected_ = state.rejected;
    tighten_ = state.tighten;
    slack_ = state.slack;
    stalled_merit_ = state.stalled_merit;
    now_ = {state.now.theta, variables_.model(state.now), {}};
    if (!finished_) {
      now_.residuals = fit_.residuals(now_.model);
      start_from(std::move(now_));
    }
    if (state.best)
      best_ = Best{state.best->theta, variables_.model(*state.best), state.best_frequency};
  }

  FitState state() const {
    FitState state{.iteration = iteration_,
                   .steps_outside = steps_outside_,
                   .finished = finished_,
                   .bound = bound_,
                   .damping = damping_,
                   .rejected = rejected_,
                   .tighten = tighten_,
                   .slack = slack_,
                   .stalled_merit = stalled_merit_,
                   .now = {now_.theta, now_.model.mass},
                   .best = {},
                   .best_frequency = best_ ? best_->highest_frequency : 0,
                   .frequency_error = mean(now_.residuals.frequency_error, 0, kLowestModes)};
    if (best_) state.best = FitPoint{best_->theta, best_->model.mass};
    return state;
  }

  void report() const {
    if (progress_.on_iteration) progress_.on_iteration(state());
  }

  Point at(Eigen::VectorXd theta) const {
    Point point{std::move(theta), {}, {}};
    point.model = variables_.model(point.theta);
    variables_.masses_to_theta(point.model.mass, point.theta);
    point.residuals = fit_.residuals(point.model);
    return point;
  }

  void start_from(Point point) {
    now_ = std::move(point);
    fit_.jacobian(now_.model, now_.residuals, linear_.jacobian);
    variables_.project_jacobian(now_.model.mass, linear_.jacobian);
    linear_.normal = elastic::gram(linear_.jacobian);
  }

  /// The level after a step; none if it cannot be measured or is not finite.
  std::optional<Point> after(const Eigen::VectorXd& step) const {
    if (!step.allFinite()) return std::nullopt;
    try {
      Point point = at((now_.theta + step).cwiseMax(-kMostChange).cwiseMin(kMostChange));
      if (point.theta.allFinite() && point.residuals.weighted.allFinite()) return point;
    } catch (const InputError&) {
      // The stiffnesses are too far apart for the factorization or the eigensolver.
    }
    return std::nullopt;
  }

  double merit(const Point& point) const {
    return point.residuals.weighted.squaredNorm() +
           constraint_weight_ * constraint_weight_ * squared_violation(point.model, bound_);
  }

  /// Step with the residuals linearized once and the constraints re-linearized along the step.
  Eigen::VectorXd next_step() {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(variables_.count());
    for (int i = 0; i < kRelinearizations && step.allFinite(); ++i) {
      const FrequencyConstraints constraints =
          frequency_constraints(variables_.model(now_.theta + step), bound_, kMargin, masses_);
      const Eigen::SparseMatrix<double, Eigen::RowMajor> constraint_jacobian =
          variables_.scaled_jacobian(constraints.jacobian);
      const Eigen::VectorXd constraint_value = constraints.value - constraint_jacobian * step;
      step = damped_step({.jacobian = linear_.jacobian,
                          .normal = linear_.normal,
                          .residual = now_.residuals.weighted,
                          .constraint_jacobian = constraint_jacobian,
                          .constraint_value = constraint_value,
                          .linearized_at = step,
                          .constraint_weight = constraint_weight_,
                          .most_rms = kMostRms},
                         damping_)
                 .cwiseMax(-kMostStep)
                 .cwiseMin(kMostStep);
    }
    return step;
  }

  /// One step, rejected if it does not lower the merit. False once the damping is at its upper end.
  bool advance() {
    std::optional<Point> next = after(next_step());
    const bool accepted = next && merit(*next) < merit(now_);
    if (accepted) {
      start_from(*std::move(next));
      if (!rejected_) damping_ = std::max(kLeastDamping, damping_ / kDampingDecrease);
    } else {
      damping_ *= kDampingIncrease;
    }
    rejected_ = !accepted;
    return damping_ <= kMostDamping;
  }

  /// Restarts from the best level, to tighten the bound in smaller steps. False if these would be
  /// too small.
  bool back_off() {
    tighten_ = std::sqrt(tighten_);
    if (tighten_ > kLeastTighten) return false;
    start_from(at(best_->theta));
    bound_ = tighten_ * largest_node_bound(now_.model);
    damping_ = kFirstDamping;
    return true;
  }

  /// Whether the mean errors of all kinds are within tolerance (docs/method.md, eq. 44), or within
  /// the slack.
  bool within_tolerance(const Point& point) const {
    const Ratios ratios = over_tolerance(point);
    return std::equal(ratios.begin(), ratios.end(), slack_.begin(), std::less_equal());
  }

  /// Mean errors of each kind over their tolerances.
  Ratios over_tolerance(const Point& point) const {
    const std::vector<double>& frequency = point.residuals.frequency_error;
    Ratios ratios{mean(frequency, 0, kLowestModes),
                  mean(frequency, kLowestModes, frequency.size()) / kHigherModesTolerance,
                  mean_of_loads(point, {LoadKind::smooth}) / kSmoothLoadsTolerance,
                  mean_of_loads(point, {LoadKind::piece, LoadKind::patch}) / kPatchLoadsTolerance,
                  mean_of_loads(point, {LoadKind::region}) / kRegionLoadsTolerance};
    for (double& ratio : ratios) ratio /= tolerance_;
    return ratios;
  }

  void give_slack_if_stalled() {
    const double merit_now = merit(now_);
    if (iteration_ == 0 || merit_now < kImprovement * stalled_merit_) {
      stalled_merit_ = merit_now;
      steps_outside_ = 0;
    }
    if (steps_outside_ < kStalled || !std::isfinite(merit_now)) return;
    const Ratios ratios = over_tolerance(now_);
    for (std::size_t kind = 0; kind < ratios.size(); ++kind)
      slack_[kind] = std::max(1.0, kSlack * ratios[kind]);
  }

  /// Mean compliance error of the loads of some kinds [1]; 0 if there are none.
  double mean_of_loads(const Point& point, std::initializer_list<LoadKind> kinds) const {
    std::vector<double> of_kinds;
    for (std::size_t l = 0; l < targets_.loads.size(); ++l)
      if (std::find(kinds.begin(), kinds.end(), targets_.loads[l].kind) != kinds.end())
        of_kinds.push_back(point.residuals.compliance_error[l]);
    return mean(of_kinds, 0, of_kinds.size());
  }

  void keep_if_better() {
    const double highest = elastic::largest_frequency(now_.model);
    if (!best_ || highest < best_->highest_frequency) best_ = Best{now_.theta, now_.model, highest};
  }

  const MassSpringModel& start_;
  const ElasticTargets& targets_;
  const FitProgress& progress_;
  NodeMasses masses_;
  std::uint32_t steps_;
  double tolerance_, least_frequency_, constraint_weight_;
  LevelVariables variables_;
  ElasticFit fit_;
  Point now_;
  Linearized linear_;
  std::optional<Best> best_;
  double bound_ = 0;  // on the squared frequencies of the nodes [rad2/s2]
  double damping_ = kFirstDamping;
  bool rejected_ = false;
  double tighten_ = kTighten;
  Ratios slack_{1, 1, 1, 1, 1};
  double stalled_merit_ = 0;
  std::uint32_t iteration_ = 0;
  std::uint32_t steps_outside_ = 0;  // since the level was last within tolerance
  bool finished_ = false;
};

}  // namespace

std::uint32_t fit_steps(const FitOptions& options, std::uint32_t nodes) {
  if (options.iterations > 0) return options.iterations;
  constexpr double kMost = 90, kLeast = 10, kFew = 500;
  return static_cast<std::uint32_t>(std::clamp(kMost * kFew / nodes, kLeast, kMost));
}

MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options,
                         const FitProgress& progress) {
  return PartFit(level, of_base, targets, options, progress).run();
}

}  // namespace springlod::lod
