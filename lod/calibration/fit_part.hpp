#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "lod/calibration/bound_schedule.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/level_variables.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// State of a fit, complete enough to resume it with bit-identical results.
struct FitState {
  std::uint32_t iteration = 0;  ///< steps done
  bool finished = false;
  BoundState bound;
  double damping = 0;            ///< of the next step, see StepProblem [1]
  double increase = 0;           ///< factor on the damping if the next step is rejected [1]
  FitPoint now;                  ///< the current level
  std::optional<FitPoint> best;  ///< the level to return so far: within tolerance
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
/// frequency is lowered step by step (docs/method.md, eqs. 39 to 46: the step in 40 to 42b, the
/// tolerance in 43 and 44, the bound in 45 and 46, see BoundSchedule). The masses (or, if they are
/// free, their moments) and c / k of each spring are kept. Returns the level within tolerance whose
/// omega_max came closest to the wanted one; if there was none, the level of lowest merit. A step
/// to a level that cannot be measured, or whose residuals are not finite, is rejected.
///
/// `level` must be connected and have springs.
MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options = {},
                         const FitProgress& progress = {});

}  // namespace springlod::lod
