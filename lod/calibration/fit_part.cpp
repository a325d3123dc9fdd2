#include "lod/calibration/fit_part.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/error.hpp"
#include "elastic/solver/dense_kernels.hpp"
#include "elastic/stable_step.hpp"
#include "lod/calibration/bound_schedule.hpp"
#include "lod/calibration/constrained_step.hpp"
#include "lod/calibration/elastic_fit.hpp"
#include "lod/calibration/error_ratios.hpp"
#include "lod/calibration/frequency_constraints.hpp"
#include "lod/calibration/tolerance.hpp"

namespace springlod::lod {
namespace {

/// Bound on each component of theta.
constexpr double kMostChange = 3;
/// Damping relative to the mean diagonal of G^T G: initial value, least and largest.
constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-5, kMostDamping = 1e6;
/// After an accepted step the damping is multiplied by 1 - (2 g - 1)^3 with the gain ratio g, the
/// actual over the predicted decrease, at least by kMostDecrease (Nielsen 1999); after a rejected
/// one by kIncrease, which doubles with each further rejection.
constexpr double kMostDecrease = 1.0 / 3, kIncrease = 2;
/// Penalty weight of a constraint, relative to a smooth load. In a level of more than 1000 nodes
/// the constraints weigh as much as those of 1000 nodes; they would outweigh the residuals
/// otherwise (docs/method.md, eq. 39).
constexpr double kConstraintWeight = 0.5, kConstraintNodes = 1000;

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
        schedule_(options.least_frequency * targets.highest_frequency *
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
      ++iteration_;
      advance();
      const SteppedLevel level = stepped();
      finished_ = !schedule_.next(level) || damping_ > kMostDamping;
      if (schedule_.within_tolerance(level.ratios)) keep(level.frequency);
    }
    if (!finished_) {
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
  struct Best {
    Eigen::VectorXd theta;
    MassSpringModel model;
    double highest_frequency = 0;
  };

  void begin() {
    start_from(at(Eigen::VectorXd::Zero(variables_.count())));
    schedule_.state.bound = largest_node_bound(start_);
  }

  void restore(const FitState& state) {
    iteration_ = state.iteration;
    finished_ = state.finished;
    schedule_.state = state.bound;
    damping_ = state.damping;
    increase_ = state.increase;
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
                   .finished = finished_,
                   .bound = schedule_.state,
                   .damping = damping_,
                   .increase = increase_,
                   .now = {now_.theta, now_.model.mass},
                   .best = {},
                   .best_frequency = best_ ? best_->highest_frequency : 0,
                   .frequency_error = mean_frequency_error(now_.residuals)};
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
           constraint_weight_ * constraint_weight_ *
               squared_violation(point.model, schedule_.state.bound);
  }

  /// One step, rejected if it does not lower the merit.
  void advance() {
    const ConstrainedStep step = constrained_step({.variables = variables_,
                                                   .theta = now_.theta,
                                                   .residual = now_.residuals.weighted,
                                                   .jacobian = linear_.jacobian,
                                                   .normal = linear_.normal,
                                                   .masses = masses_,
                                                   .bound = schedule_.state.bound,
                                                   .constraint_weight = constraint_weight_},
                                                  damping_);
    std::optional<Point> next = step.predicted > 0 ? after(step.change) : std::nullopt;
    const double decrease = next ? merit(now_) - merit(*next) : 0;
    if (decrease > 0) {
      start_from(*std::move(next));
      const double gain = decrease / step.predicted;
      damping_ *= std::max(kMostDecrease, 1 - std::pow(2 * gain - 1, 3));
      damping_ = std::max(kLeastDamping, damping_);
      increase_ = kIncrease;
    } else {
      damping_ *= increase_;
      increase_ *= 2;
    }
  }

  SteppedLevel stepped() const {
    return {.frequency = elastic::largest_frequency(now_.model),
            .node_bound = largest_node_bound(now_.model),
            .merit = merit(now_),
            .ratios = error_ratios(now_.residuals, targets_, tolerance_)};
  }

  /// Keeps the current level if its omega_max is low enough, because later levels have lower
  /// errors then, or lower than that of the kept one.
  void keep(double frequency) {
    if (!best_ || frequency < best_->highest_frequency || schedule_.low_enough(frequency))
      best_ = Best{now_.theta, now_.model, frequency};
  }

  const MassSpringModel& start_;
  const ElasticTargets& targets_;
  const FitProgress& progress_;
  NodeMasses masses_;
  std::uint32_t steps_;
  double tolerance_;
  BoundSchedule schedule_;
  double constraint_weight_;
  LevelVariables variables_;
  ElasticFit fit_;
  Point now_;
  Linearized linear_;
  std::optional<Best> best_;
  double damping_ = kFirstDamping;
  double increase_ = kIncrease;
  std::uint32_t iteration_ = 0;
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
