#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/level_variables.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod {

/// All that a fit goes on from: the same state leads to the same bits.
struct FitState {
  std::uint32_t iteration = 0;  ///< steps made
  std::uint32_t tries = 0;      ///< of them, since the level was good
  bool finished = false;
  double limit = 0;    ///< of the nodes' own squared frequencies [rad2/s2]
  double damping = 0;  ///< of the next step [1]
  double tighten = 0;  ///< what the limit is multiplied by while the level is good [1]
  FitPoint now;
  std::optional<FitPoint> best;  ///< of those good enough that with the lowest largest frequency
  double best_frequency = 0;     ///< that frequency [rad/s]
  double frequency_error = 0;    ///< of now: mean of the ten lowest [1]; only to be shown
};

struct FitOptions {
  /// Steps at most; 0: 90 for up to 500 nodes, down to 10 for large levels, see fit_steps.
  std::uint32_t iterations = 0;
  /// Mean error of the ten lowest frequencies that is good enough [1], 0: see frequency_tolerance;
  /// the other modes may miss by four times as much, smooth loads and those of regions by eight,
  /// loads of patches and pieces by twenty times as much.
  double tolerance = 0;
  /// Where the largest frequency need not fall any further, over that of a lattice of as many
  /// nodes, omega0 (N / N0)^(1/3): below it local loads are answered worse.
  double least_frequency = 0.85;
  /// Of pieces too: how a body moves when it is hit in one place then is more like its base, its
  /// largest frequency less low, for the nodes that are stiff may not be given the others' mass.
  KeptMoments moments = KeptMoments::body;
  std::uint32_t threads = 1;       ///< up to two are used; the same bits for any number
  std::optional<FitState> from{};  ///< goes on from here, where a fit of the same things was
  /// Called after each step, and once when the fit is finished. May throw to stop.
  std::function<void(const FitState&)> on_iteration{};
};
constexpr auto option_rows(const FitOptions*) {
  return std::tuple(
      option(
          "tolerance", &FitOptions::tolerance,
          "mean error of the ten lowest frequencies that is good enough; other modes may miss by "
          "four times as much, smooth loads and regions by eight, patches by twenty")
          .by_default("0.002 sqrt(N0 / N)"),
      option("iterations", &FitOptions::iterations,
             "steps at most; by itself fewer for levels of more than 500 nodes, down to 10")
          .by_default("90"),
      option("least_frequency", &FitOptions::least_frequency,
             "where the largest frequency, which bounds the step, need not fall any further, over "
             "that of a lattice of as many nodes"),
      option("moments", &FitOptions::moments,
             "masses shift between nodes; which mass, centre and second moments stay"));
}

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
                         const ElasticTargets& targets, const FitOptions& options = {});

}  // namespace springlod
