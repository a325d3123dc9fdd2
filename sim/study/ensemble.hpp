#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"
#include "sim/study/starts.hpp"

namespace springlod {

/// Many starts of one model. Starts with the same seed, jitter and number are the same for every
/// model of the same centre of mass: paired.
struct EnsembleOptions {
  std::uint32_t starts = 24;
  std::uint32_t first_start = 0;  ///< number of the first of them; number 0 has no jitter
  double jitter = 0.02;           ///< see `jittered`
  std::uint64_t seed = 1;
  std::uint32_t threads = 0;  ///< 0: all cores. Never changes the result
  RunOptions run = {.frame_rate = 0, .ledger = false};
  Progress* progress = nullptr;
};
constexpr auto option_rows(const EnsembleOptions*) {
  return std::tuple(
      option("starts", &EnsembleOptions::starts, "starts, the same for every level"),
      option("jitter", &EnsembleOptions::jitter,
             "relative change of speed and height from start to start; the first has none"),
      option("seed", &EnsembleOptions::seed, "of the jitter"),
      option("threads", &EnsembleOptions::threads, kThreadsHelp), nested(&EnsembleOptions::run));
}

struct EnsembleRun : RunSummary {
  std::uint32_t start = 0;  ///< its number
};

/// Runs the model from every start, spread over threads; one result a start, in their order.
/// Throws what the first run that failed threw, naming the start.
std::vector<EnsembleRun> run_ensemble(const MassSpringModel& model, const Scenario& scenario,
                                      const EnsembleOptions& options = {});

}  // namespace springlod
