#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/level_variables.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// All that a fit goes on from: the same state leads to the same bits.
struct FitState {
  std::uint32_t iteration = 0;      ///< steps made
  std::uint32_t steps_outside = 0;  ///< of them, since the level was good
  bool finished = false;
  double bound = 0;    ///< of the nodes' own squared frequencies [rad2/s2]
  double damping = 0;  ///< of the next step [1]
  double tighten = 0;  ///< what the limit is multiplied by while the level is good [1]
  FitPoint now;
  std::optional<FitPoint> best;  ///< of those good enough that with the lowest largest frequency
  double best_frequency = 0;     ///< that frequency [rad/s]
  double frequency_error = 0;    ///< of now: mean of the ten lowest [1]; only to be shown
};

/// Where a fit begins, and who watches it.
struct FitProgress {
  std::optional<FitState> from{};  ///< goes on from here, where a fit of the same things was
  /// Called after each step, and once when the fit is finished. May throw to stop.
  std::function<void(const FitState&)> on_iteration{};
};

/// Steps that are made at most for a level of so many nodes: each takes the square of them in time,
/// and what the last ones of many still gain is little.
std::uint32_t fit_steps(const FitOptions& options, std::uint32_t nodes);

/// Changes the stiffnesses and masses of a level until it swings and gives way as its base does,
/// then lowers its largest frequency for as long as it still does (after spec 4.1): Gauss-Newton
/// steps of least norm in ln k and ln m, damped (Levenberg-Marquardt), under a falling limit of the
/// nodes' own frequencies. Moments of mass stay; c keeps its part of k. Comes back with the level
/// of the lowest largest frequency of those good enough; if none was, with the best fit. A step to
/// where the level cannot be measured, or not in finite numbers, counts as one that did not help.
///
/// `level` must be one connected part and have springs.
MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options = {},
                         const FitProgress& progress = {});

}  // namespace springlod::lod
