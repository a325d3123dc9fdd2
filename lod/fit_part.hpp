#pragma once

#include <cstdint>
#include <functional>

#include "lod/elastic_targets.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod {

struct FitOptions {
  std::uint32_t iterations = 90;
  /// Mean error of the ten lowest frequencies that is good enough [1], 0: see frequency_tolerance;
  /// the other modes may miss by four times as much, smooth loads and those of regions by eight,
  /// loads of patches and pieces by twenty times as much.
  double tolerance = 0;
  /// Where the largest frequency need not fall any further, over that of a lattice of as many
  /// nodes, omega0 (N / N0)^(1/3): below it local loads are answered worse.
  double least_frequency = 0.85;
  std::function<void()> on_iteration{};  ///< may throw to stop
};

/// Changes the stiffnesses and masses of a level until it swings and gives way as its base does,
/// then lowers its largest frequency for as long as it still does (after spec 4.1): Gauss-Newton
/// steps of least norm in ln k and ln m, damped (Levenberg-Marquardt), under a falling limit of the
/// nodes' own frequencies. Moments of mass stay; c keeps its part of k. Comes back with the level
/// of the lowest largest frequency of those good enough; if none was, with the best fit.
///
/// `level` must be one connected part and have springs.
MassSpringModel fit_part(const MassSpringModel& level, const Groups& of_base,
                         const ElasticTargets& targets, const FitOptions& options = {});

}  // namespace springlod
