#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/level_variables.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// State of a fit, complete enough to resume it with bit-identical results.
struct FitState {
  std::uint32_t iteration = 0;  ///< steps done
  /// Steps since the level was last within tolerance; before it is for the first time, steps
  /// without a clear improvement.
  std::uint32_t steps_outside = 0;
  bool finished = false;
  double bound = 0;       ///< tau, on the squared frequencies of the nodes [rad2/s2]
  double damping = 0;     ///< of the next step, see StepProblem [1]
  bool rejected = false;  ///< the last step was
  double tighten = 0;     ///< factor on the bound each time the level is within tolerance [1]
  /// Factor on the tolerance of each kind of error: modes 1 to 10, higher modes, smooth loads,
  /// patch and piece loads, region loads [1].
  std::array<double, 5> slack{1, 1, 1, 1, 1};
  double stalled_merit = 0;  ///< merit that the level must fall clearly below to count as improving
  FitPoint now;              ///< the current level
  std::optional<FitPoint> best;  ///< within tolerance, with the lowest omega_max so far
  double best_frequency = 0;     ///< omega_max of `best` [rad/s]
  double frequency_error = 0;    ///< mean of the ten lowest at `now` [1]; for display only
};

/// Start state and observer of a fit.
struct FitProgress {
  std::optional<FitState> from{};  ///< resumes from this state of a fit with the same input
  /// Called after each step and when the fit has finished. May throw to stop the fit.
  std::function<void(const FitState&)> on_iteration{};
};

/// Largest number of steps for a level of `nodes` nodes: options.iterations if set, otherwise 90,
/// falling to 10 for large levels. The time of a step grows as the square of the nodes, and late
/// steps gain little.
std::uint32_t fit_steps(const FitOptions& options, std::uint32_t nodes);

/// Levenberg-Marquardt fit of log-stiffnesses (and log-masses, if these are free) to the base's
/// natural frequencies, mode shapes and static compliances, while the bound on the level's highest
/// frequency is tightened step by step (docs/method.md, eqs. 39 to 46: the step in 40 to 42, the
/// tolerance in 43 and 44, tightening in 45, stopping in 46). The masses (or, if they are free,
/// their moments) and c / k of each spring are kept. If a level stops improving before it is
/// within tolerance, the tolerances that it exceeds get as much slack as it needs, so that its
/// bound is tightened too. Returns the level of lowest omega_max among those within tolerance; if
/// there was none, the level of lowest merit. A step to a level that cannot be measured, or whose
/// residuals are not finite, is rejected.
///
/// `level` must be connected and have springs.
MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options = {},
                         const FitProgress& progress = {});

}  // namespace springlod::lod
