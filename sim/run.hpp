#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "model/mass_spring.hpp"
#include "model/progress.hpp"
#include "sim/ledger.hpp"
#include "sim/scenario.hpp"

namespace springlod {

enum class Integrator { symplectic_euler, velocity_verlet };

struct RunOptions {
  Integrator integrator = Integrator::symplectic_euler;
  /// Step [s]; left out: `safety` times the predicted stable step, contact stiffness included.
  std::optional<double> step;
  double safety = 0.8;
  /// Frames kept a second of simulated time; 0: only the first and last state.
  double frame_rate = 60;
  /// Record the energy ledger (costs about half as much again).
  bool ledger = true;
  Progress* progress = nullptr;
};

struct Frame {
  double time = 0;      ///< [s]
  std::vector<Vec3> x;  ///< [m]
};

/// One run of one model: deterministic, single-threaded.
struct Trajectory {
  double step = 0;            ///< [s]
  double predicted_step = 0;  ///< stable step predicted for the model and its contacts [s]
  std::uint64_t steps = 0;
  std::uint64_t spring_updates = 0;     ///< steps x springs: the deterministic measure of cost
  double simulated = 0;                 ///< [s]; below the duration if a stop rule ended the run
  double wall_seconds = 0;              ///< measured; never part of a result that must repeat
  std::vector<Frame> frames;            ///< at the frame times, first and last included
  std::vector<LedgerEntry> ledger;      ///< one a frame; empty if not asked for
  std::optional<double> first_contact;  ///< [s]
  State final;
};

/// Step that `run` takes if none is given, before safety: see stable_step, with the contact
/// stiffness of the nodes with an area added to the springs.
double predicted_step(const MassSpringModel& model, const Scenario& scenario);

/// Runs the model under the scenario. Throws UnstableError naming node and time as soon as a
/// coordinate stops being finite or the energy grows without a source.
Trajectory run(const MassSpringModel& model, const Scenario& scenario,
               const RunOptions& options = {});

}  // namespace springlod
