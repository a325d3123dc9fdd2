#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "sim/run.hpp"
#include "sim/scenario.hpp"
#include "sim/study/no_contact.hpp"

namespace springlod::sim {

struct PredictOptions {
  double error_window = 0.25;  ///< as in CompareOptions [s]
  std::uint32_t threads = 0;   ///< 0: all cores. Never changes the result
  RunOptions run = {.ledger = false};
  ContactAt contact = ContactAt::nodes;
  Progress* progress = nullptr;
};

/// Predicted surface error of a level and its four causes (docs/method.md, eqs. 73a to 73e) [m].
struct PredictedError {
  double error = 0;    ///< infinite for a level without springs
  double contact = 0;  ///< the level touches obstacles elsewhere, so earlier or later
  double inertia = 0;  ///< other moments of inertia: it rotates differently in flight
  double elastic = 0;  ///< other compliances: it deforms differently
  double impulse = 0;  ///< other contact forces: its motion changes differently
};

struct Prediction {
  std::vector<PredictedError> levels;   ///< one for each level of the chain; all 0 for the base
  std::optional<double> first_contact;  ///< of the coarsest level, at the surface of the base [s]
  std::optional<NoContact> no_contact;  ///< of the same run
  double end = 0;                       ///< of the window in which errors are averaged [s]
  std::uint64_t spring_updates = 0;     ///< cost of all runs
  std::uint32_t probe = 0;              ///< the level that was run; 0: none has springs
  /// Processor time for a simulated second of that level in the scene, with contact points at its
  /// own nodes and at the surface of the base [s/s]; measured, not reproducible.
  double cost_at_nodes = 0, cost_at_surface = 0;
};

/// Predicts the surface error of every level (as `compare` measures it) without a run of the base:
/// from the certificates and from runs of the coarsest level that has springs. Results are
/// bit-identical for any number of threads. Throws InputError for a level with springs but without
/// certificate; the errors of `run` for a run that failed.
Prediction predict_errors(const LodChain& chain, const Scenario& scenario,
                          const PredictOptions& options);

}  // namespace springlod::sim
