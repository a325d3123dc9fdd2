#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/fast/layout.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/ledger.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

class FastModel;
struct StepLimit;

struct RunOptions {
  Integrator integrator = Integrator::symplectic_euler;
  SolverOptions solver = {};  ///< for the implicit schemes
  /// Step [s]; left out: 1 ms for the implicit schemes, for the others `safety` times the predicted
  /// stable step, contact stiffness included; symplectic Euler halves it where springs are
  /// stretched or flattened so far that it would not hold, and doubles it again afterwards.
  std::optional<double> step = std::nullopt;
  double safety = 0.8;
  /// A body that touches an obstacle is left to sleep, at no cost, once its nodes' mean speed has
  /// stayed below this part of sqrt(|g| size), about that of a fall through its own size [1]; 0:
  /// never.
  double sleep = 1e-5;
  /// Frames kept a second of simulated time; 0: only the first and last state.
  double frame_rate = 60;
  /// Record the energy ledger (costs about half as much again).
  bool ledger = true;
  /// Of the numbers that symplectic Euler moves the body with; see docs/precision.md.
  Precision precision = Precision::double_precision;
  Layout layout = Layout::fastest;  ///< of the springs for symplectic Euler
  /// Threads for symplectic Euler; 0: as many as the body is worth. Never changes the result.
  std::uint32_t threads = 1;
  /// Where the body touches obstacles; none: at its own nodes, those of a coarse level deep inside
  /// the base's surface. See contact_skin.
  std::shared_ptr<const ContactSkin> skin = nullptr;
  Progress* progress = nullptr;
};
constexpr auto option_rows(const RunOptions*) {
  return std::tuple(
      option("integrator", &RunOptions::integrator, "time integration scheme"),
      nested(&RunOptions::solver),
      option("step", &RunOptions::step, "time step")
          .in(Dimension::time)
          .by_default("safety times the predicted stable step; 1 ms for the implicit schemes"),
      option("safety", &RunOptions::safety, "step as a fraction of the predicted stable step"),
      option("precision", &RunOptions::precision, "floating-point precision of symplectic_euler"),
      option("layout", &RunOptions::layout, "memory layout of the springs for symplectic_euler"),
      option("sleep", &RunOptions::sleep,
             "a body that touches something sleeps, at no cost, once its mean speed stays below "
             "this part of that of a fall through its own size; 0: never"),
      option("frame_rate", &RunOptions::frame_rate,
             "frames stored per simulated second; 0: only the first and the last"),
      option("ledger", &RunOptions::ledger, "record the energy ledger"));
}

inline constexpr const char* kThreadsHelp = "0: all cores; never changes a result";

/// Two nodes joined by a spring that went past each other: it turned over between two checks of the
/// body, beyond what the body as a whole turned.
struct Crossing {
  std::uint32_t a = 0;  ///< node
  std::uint32_t b = 0;  ///< node
  double time = 0;      ///< of the check that found it [s]
};

struct Frame {
  double time = 0;      ///< [s]
  std::vector<Vec3> x;  ///< [m]
};

/// One run of one model: deterministic, single-threaded.
struct Trajectory {
  double step = 0;            ///< at rest [s]
  double shortest_step = 0;   ///< where springs were strained hard [s]
  double predicted_step = 0;  ///< stable step predicted for the model and its contacts [s]
  std::uint64_t steps = 0;
  /// Springs evaluated, in every step and iteration: the deterministic measure of cost. (A sparse
  /// factorization, of which it knows nothing, counts as one pass.)
  std::uint64_t spring_updates = 0;
  /// Steps that the solver of backward Euler ended short of its tolerance.
  std::uint64_t unconverged_steps = 0;
  double simulated = 0;                 ///< [s]; below the duration if a stop rule ended the run
  double wall_seconds = 0;              ///< measured; never part of a result that must repeat
  double planning_seconds = 0;          ///< of these what went before the first step (plan_runs)
  std::vector<Frame> frames;            ///< at the frame times, first and last included
  std::vector<LedgerEntry> ledger;      ///< one a frame; empty if not asked for
  std::optional<double> first_contact;  ///< [s]
  std::optional<double> asleep_since;   ///< [s]; from there on it was not moved any more
  /// The first springs to turn over: from there on the body is inside out at that place.
  std::optional<Crossing> first_crossing;
  State final;
};

/// What runs of one model have in common, whatever their start: may be shared between threads.
struct RunPlan {
  std::shared_ptr<const StepLimit> limit;             ///< never null
  std::shared_ptr<const FastModel> layout = nullptr;  ///< for symplectic Euler
};
/// For all runs with these options and obstacles. Throws InputError for a wrong model, scenario or
/// option.
RunPlan plan_runs(const MassSpringModel& model, const Scenario& scenario,
                  const RunOptions& options);

/// Runs the model under the scenario. The step is `safety` times the predicted one, shortened so
/// that the duration is a whole number of steps, or exactly the one given. Frames lie exactly at
/// the frame times, between steps on the straight line that the scheme draws; ledger entries at the
/// last step before. Throws InputError for a wrong model, scenario or option, UnstableError naming
/// node and time as soon as a coordinate stops being finite or the energy grows without a source,
/// TunnelError as soon as a node has gone through a box.
Trajectory run(const MassSpringModel& model, const Scenario& scenario,
               const RunOptions& options = {});
/// From positions and velocities of its own instead of the scenario's throw.
Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options);
/// With what was planned for this model, these obstacles and these options.
Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan);

/// What Scenario::measure_from asks for [m], from the displacement of the centre of mass.
double measured_distance(const Scenario& scenario, const Vec3& first_center,
                         const Vec3& final_center);

}  // namespace springlod::sim
