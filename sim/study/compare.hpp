#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"
#include "sim/study/ensemble.hpp"

namespace springlod::sim {

struct CompareOptions {
  /// Paired starts: the same jitter for every level. If they do not differ (starts_differ), only
  /// the first one is run.
  std::uint32_t starts = 1;
  double jitter = 0.02;  ///< relative, uniform, on speed and start height; the first start has none
  std::uint64_t seed = 1;
  std::uint32_t threads =
      0;  ///< runs are spread over threads; 0: all cores. Never changes the result
  /// Options for all levels; each level has its own skin, and holds the groups of the anchored
  /// nodes of the base.
  RunOptions run = {};
  std::optional<ContactAt> contact = {};  ///< empty: that of the chain
  /// Errors are averaged from t = 0 to this long after the base's first contact [s].
  double error_window = 0.25;
  /// Start of the labels of the levels: "hb" gives "hb level 1"; empty: "level 1".
  std::string variant = {};
  Progress* progress = nullptr;
};
constexpr auto option_rows(const CompareOptions*) {
  return std::tuple(
      option("starts", &CompareOptions::starts,
             "number of starts, the same for every level; 1 is run if they would not differ")
          .within(1, 1e6),
      option("jitter", &CompareOptions::jitter,
             "relative random change of speed and height of each start after the first")
          .within(0, 1),
      option("seed", &CompareOptions::seed, "seed of the jitter"),
      option("threads", &CompareOptions::threads, kThreadsHelp).within(0, 1024),
      option("error_window", &CompareOptions::error_window,
             "time after the base's first contact up to which errors are averaged")
          .within(0, 1e6)
          .in(Dimension::time),
      option("variant", &CompareOptions::variant,
             "start of the labels: \"hb\" makes \"hb level 1\"")
          .by_default("none"),
      nested(&CompareOptions::run));
}

/// Results of one level in one start.
struct StartResult : RunSummary {
  /// Mass-weighted RMS distance of the level-0 nodes from the base's, averaged over the frames of
  /// the window [m].
  double surface_error = 0;
  double shape_error = 0;  ///< the same after the best rigid fit, over all common frames [m]
  /// Largest difference of the mechanical energy from the base's at one time, over the base's
  /// largest kinetic energy [1]: the maximum energy difference of Yeh, Reinman, Patel, Faloutsos
  /// 2009 (they divide by the total energy, which is defined only up to a constant). 0 without a
  /// ledger.
  double energy_difference = 0;
};

struct LevelRuns {
  std::string label;  ///< "base", "hb level 1"
  std::uint32_t level = 0;
  std::vector<StartResult> starts;
  Trajectory first;                ///< of the first start
  std::vector<Frame> base_frames;  ///< its frames, mapped to level 0 (N0 positions each)
};

struct Comparison {
  Scenario scenario;
  std::vector<LevelRuns> levels;
  double error_window = 0;  ///< that of the options [s]
};

/// How users know a level: "base", "level 1", with a variant "hb level 1".
std::string level_label(std::uint32_t level, const std::string& variant = {});

/// Time until which the surface errors of the first start are averaged [s]; empty if that is the
/// whole run.
std::optional<double> error_end(const Comparison& comparison);

/// Runs every level of the chain from the same starts, spread over threads; the result does not
/// depend on their number. Only the frames of the first start are kept. With frame_rate 0 there are
/// no frames in between, and the errors are meaningless. Throws the exception of the first run that
/// failed, with its level and start in the message; InterruptedError from `progress` stops all
/// runs.
Comparison compare(const LodChain& chain, const Scenario& scenario,
                   const CompareOptions& options = {});

/// Several chains of one base, which runs once for all of them: the same as a comparison of each.
/// `variants`: start of the labels of each, as CompareOptions::variant, which is not used; or
/// empty. Throws InputError also for chains of different bases.
std::vector<Comparison> compare(const std::vector<const LodChain*>& chains,
                                const Scenario& scenario, const CompareOptions& options,
                                const std::vector<std::string>& variants);

}  // namespace springlod::sim
