#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// The start of run number `index`: speed times 1 + jitter u1, height (z of the centre of mass)
/// times 1 + jitter u2, with u1, u2 uniform in [-1, 1) from (seed, index) alone; index 0 stays as
/// it is. `center`: centre of mass of the model, used if the start has no position.
Throw jittered(const Throw& start, const Vec3& center, double jitter, std::uint64_t seed,
               std::uint32_t index);

/// Whether the starts of `jittered` lead to different motions. They do not without a jitter, nor
/// without a velocity if the height does not matter either: there is nothing that the body could
/// touch, and no anchor turns about a fixed point.
bool starts_differ(const Scenario& scenario, const Vec3& center, double jitter,
                   const std::vector<Anchor>& anchors);

/// Results of one run of an ensemble.
struct RunSummary {
  double distance = 0;   ///< Scenario::measure_from at the end [m]
  double simulated = 0;  ///< [s]
  std::uint64_t spring_updates = 0;
  double wall_seconds = 0;  ///< measured; kept out of results
  double ledger_error = 0;  ///< closure_error; 0 without a ledger
  std::uint64_t unconverged_steps = 0;
  std::optional<double> first_crossing;   ///< when springs first inverted [s], see Trajectory
  std::optional<double> first_inversion;  ///< when corners first were inside out [s]
  std::uint32_t most_inverted = 0;        ///< largest number of corners inside out at one time
  std::uint32_t inverted_at_end = 0;      ///< corners inside out at the end
};

/// Runs the model from the scenario's start and returns a summary. `center`: the body's centre of
/// mass if the start has no position. `plan`: of the model under this scenario; the same for all
/// starts. Throws the errors of run, prefixed with `name`.
Trajectory run_start(const MassSpringModel& model, const Scenario& scenario, const Vec3& center,
                     const RunOptions& options, const RunPlan& plan, const std::string& name,
                     RunSummary& summary);

/// Many starts of one model. Starts with the same seed, jitter and number are the same for all
/// models with the same centre of mass; samples are therefore paired.
struct EnsembleOptions {
  std::uint32_t starts = 24;
  std::uint32_t first_start = 0;  ///< number of the first start; number 0 has no jitter
  double jitter = 0.02;           ///< see `jittered`
  std::uint64_t seed = 1;
  std::uint32_t threads = 0;  ///< 0: all cores. Never changes the result
  RunOptions run = {.frame_rate = 0, .ledger = false};
  Progress* progress = nullptr;
};
constexpr auto option_rows(const EnsembleOptions*) {
  return std::tuple(
      option("starts", &EnsembleOptions::starts, "number of starts, the same for every level")
          .within(1, 1e6),
      option("jitter", &EnsembleOptions::jitter,
             "relative random change of speed and height of each start after the first")
          .within(0, 1),
      option("seed", &EnsembleOptions::seed, "seed of the jitter"),
      option("threads", &EnsembleOptions::threads, kThreadsHelp).within(0, 1024),
      nested(&EnsembleOptions::run));
}

struct EnsembleRun : RunSummary {
  std::uint32_t start = 0;  ///< its number
};

/// Runs the model from every start, spread over threads; one result per start, in the order of
/// starts. Throws the exception of the first run that failed, with its start in the message.
std::vector<EnsembleRun> run_ensemble(const MassSpringModel& model, const Scenario& scenario,
                                      const EnsembleOptions& options = {});

}  // namespace springlod::sim
