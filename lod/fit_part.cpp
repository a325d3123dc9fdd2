#include "lod/fit_part.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "lod/damped_step.hpp"
#include "lod/elastic_fit.hpp"
#include "lod/frequency_cap.hpp"
#include "lod/mass_moments.hpp"
#include "lod/tolerance.hpp"
#include "model/dense_kernels.hpp"
#include "model/stable_step.hpp"

namespace springlod {
namespace {

/// What ln m changes for each unit of an unknown, where ln k changes by 1: masses are better known.
constexpr double kMassScale = 0.5;
/// Bounds of the unknowns: of one step, its root mean square, and of all steps together.
constexpr double kMostStep = 1, kMostRms = 0.15, kMostChange = 3;
/// Damping over the mean of the slopes' squared norms: at the start, and bounds of it.
constexpr double kFirstDamping = 1e-2, kLeastDamping = 1e-5, kMostDamping = 1e6;
/// What the damping is divided by after a step that helped, multiplied by after one that did not.
constexpr double kTrust = 3, kDistrust = 4;
/// Weight of a node above the limit, where a miss of a load that is fitted has 1. More nodes than
/// so many share the weight of these, or the misses would not count beside them.
constexpr double kLimitWeight = 0.5, kLimitNodes = 1000;
/// How often a step follows the limits through their bends: they are cheap to tell anew, where
/// misses take most of the time.
constexpr int kBends = 4;
/// What the limit of squared frequencies falls to while the level is good, at first; its root when
/// a level did not become good again in so many steps, down to hardly any fall.
constexpr double kTighten = 0.8, kLeastTighten = 0.98;
constexpr std::uint32_t kPatience = 10;
/// The limit over the largest bound there is, at least: one farther below pulls at all nodes, and
/// no longer at the ones that matter.
constexpr double kLeastLimit = 0.68;
/// Nodes that far below the limit are not looked at in a step (in ln of squared frequencies).
constexpr double kMargin = 1;

/// What patch loads may be missed by, over the tolerance of the lowest frequencies.
constexpr double kPatchLoadsTolerance = 20;

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  end = std::min(end, values.size());
  double sum = 0;
  for (std::size_t i = begin; i < end; ++i) sum += values[i];
  return end > begin ? sum / static_cast<double>(end - begin) : 0;
}

class PartFit {
 public:
  PartFit(const MassSpringModel& level, const Groups& of_base, const ElasticTargets& targets,
          const FitOptions& options)
      : start_(level),
        targets_(targets),
        options_(options),
        tolerance_(frequency_tolerance(options.tolerance, targets.nodes, level.node_count())),
        least_frequency_(options.least_frequency * targets.highest_frequency *
                         std::cbrt(static_cast<double>(level.node_count()) / targets.nodes)),
        limit_weight_(kLimitWeight * std::sqrt(std::min(1.0, kLimitNodes / level.node_count()))),
        fit_(level, of_base, targets),
        moments_(level) {}

  MassSpringModel run() {
    now_ = at(Eigen::VectorXd::Zero(springs() + nodes()));
    limit_ = largest_node_bound(start_);
    std::uint32_t tries = 0;  // steps since the level was good
    for (std::uint32_t i = 0; i < options_.iterations; ++i) {
      if (good(now_)) {
        keep_if_better();
        if (best_->highest_frequency <= least_frequency_) break;
        const double bound = largest_node_bound(now_.model);
        limit_ = std::max(tighten_ * std::min(limit_, bound), kLeastLimit * bound);
        tries = 0;
      } else if (best_ && (tries >= kPatience || damping_ > kMostDamping)) {
        if (!back_off()) break;
        tries = 0;
      }
      ++tries;
      if (!advance() && !best_) break;
      if (options_.on_iteration) options_.on_iteration();
    }
    if (good(now_)) keep_if_better();
    return best_ ? std::move(best_->model) : std::move(now_.model);
  }

 private:
  using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct Point {
    Eigen::VectorXd theta;  // ln k, then ln m / kMassScale, over those of the start
    MassSpringModel model;
    ElasticMisses misses;    // slopes by theta, along changes that keep the moments
    Eigen::MatrixXd normal;  // slopes^T slopes
  };
  struct Best {
    Eigen::VectorXd theta;
    MassSpringModel model;
    double highest_frequency = 0;
  };

  Eigen::Index springs() const { return start_.spring_count(); }
  Eigen::Index nodes() const { return start_.node_count(); }

  MassSpringModel model_at(const Eigen::VectorXd& theta) const {
    MassSpringModel model = start_;
    for (std::uint32_t s = 0; s < start_.spring_count(); ++s) {
      const double factor = std::exp(theta[s]);
      model.stiffness[s] *= factor;
      model.damping[s] *= factor;
    }
    for (std::uint32_t i = 0; i < start_.node_count(); ++i)
      model.mass[i] *= std::exp(kMassScale * theta[springs() + i]);
    moments_.restore(model.mass);
    return model;
  }

  Point at(Eigen::VectorXd theta) const {
    Point point{std::move(theta), {}, {}, {}};
    point.model = model_at(point.theta);
    for (std::uint32_t i = 0; i < start_.node_count(); ++i)
      point.theta[springs() + i] = std::log(point.model.mass[i] / start_.mass[i]) / kMassScale;
    point.misses = fit_.misses(point.model);
    point.misses.slopes.bottomRows(nodes()) *= kMassScale;
    moments_.project(point.model.mass, point.misses.slopes.bottomRows(nodes()));
    point.normal = gram(point.misses.slopes);
    return point;
  }

  double merit(const Point& point) const {
    return point.misses.miss.squaredNorm() +
           limit_weight_ * limit_weight_ * squared_excess(point.model, limit_);
  }

  /// The step that suits the misses as they go on straight, and the limits as they bend.
  Eigen::VectorXd next_step() {
    Eigen::VectorXd scale = Eigen::VectorXd::Ones(springs() + nodes());
    scale.tail(nodes()).setConstant(kMassScale);
    Eigen::VectorXd step = Eigen::VectorXd::Zero(springs() + nodes());
    for (int bend = 0; bend < kBends; ++bend) {
      const CapRows cap = cap_rows(model_at(now_.theta + step), limit_, kMargin);
      const SparseRows limits = cap.slopes * scale.asDiagonal();
      const Eigen::VectorXd excess = cap.excess - limits * step;
      step = damped_step({.slopes = now_.misses.slopes,
                          .normal = now_.normal,
                          .miss = now_.misses.miss,
                          .limits = limits,
                          .excess = excess,
                          .near = step,
                          .limit_weight = limit_weight_,
                          .most_rms = kMostRms},
                         damping_)
                 .cwiseMax(-kMostStep)
                 .cwiseMin(kMostStep);
    }
    return step;
  }

  /// One step; it is taken back if it did not help. False if none will any more.
  bool advance() {
    Point next = at((now_.theta + next_step()).cwiseMax(-kMostChange).cwiseMin(kMostChange));
    if (merit(next) < merit(now_)) {
      now_ = std::move(next);
      damping_ = std::max(kLeastDamping, damping_ / kTrust);
    } else {
      damping_ *= kDistrust;
    }
    return damping_ <= kMostDamping;
  }

  /// Returns to the best level, to go on from there in smaller steps. False if they would be too
  /// small.
  bool back_off() {
    tighten_ = std::sqrt(tighten_);
    if (tighten_ > kLeastTighten) return false;
    now_ = at(best_->theta);
    limit_ = tighten_ * largest_node_bound(now_.model);
    damping_ = kFirstDamping;
    return true;
  }

  /// Whether all kinds of misses are within what is wanted.
  bool good(const Point& point) const {
    const std::vector<double>& frequency = point.misses.frequency;
    const std::vector<double>& compliance = point.misses.compliance;
    const std::size_t smooth = targets_.smooth_loads;
    return mean(frequency, 0, kLowestModes) <= tolerance_ &&
           mean(frequency, kLowestModes, frequency.size()) <= kHigherModesTolerance * tolerance_ &&
           mean(compliance, 0, smooth) <= kSmoothLoadsTolerance * tolerance_ &&
           mean(compliance, smooth, compliance.size()) <= kPatchLoadsTolerance * tolerance_;
  }

  void keep_if_better() {
    const double highest = largest_frequency(now_.model);
    if (!best_ || highest < best_->highest_frequency) best_ = Best{now_.theta, now_.model, highest};
  }

  const MassSpringModel& start_;
  const ElasticTargets& targets_;
  const FitOptions& options_;
  double tolerance_, least_frequency_, limit_weight_;
  ElasticFit fit_;
  MassMoments moments_;
  Point now_;
  std::optional<Best> best_;
  double limit_ = 0;  // of the nodes' own squared frequencies [rad2/s2]
  double damping_ = kFirstDamping;
  double tighten_ = kTighten;
};

}  // namespace

MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options) {
  return PartFit(level, of_base, targets, options).run();
}

}  // namespace springlod
