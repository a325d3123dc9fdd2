#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/progress.hpp"
#include "model/mass_spring.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/correction/inversion.hpp"
#include "sim/fast/layout.hpp"
#include "sim/held/anchor.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/ledger.hpp"
#include "sim/integrators/step_bound.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

class FastModel;
struct StepLimit;

struct RunOptions {
  Integrator integrator = Integrator::symplectic_euler;
  SolverOptions solver = {};  ///< for the implicit schemes
  /// Step [s]. Default: 1 ms for the implicit schemes; for the others, `safety` times the predicted
  /// stable step. Symplectic Euler halves the step while springs are
  /// stretched or flattened so much that it would be unstable, or while corners change fast; later
  /// it doubles it again.
  std::optional<double> step = std::nullopt;
  double safety = 0.8;
  /// A body in contact sleeps, at no cost, once the mean speed of its nodes has stayed below this
  /// fraction of sqrt(|g| size), which is about the speed after a fall through its own size [1]; 0:
  /// never.
  double sleep = 1e-5;
  /// Stored frames per second of simulated time; 0: only the first and last state.
  double frame_rate = 60;
  /// Whether the corners of the model resist inversion (model/corners.hpp). Only the explicit
  /// schemes have them. They are watched and reported in any case.
  bool volumes = true;
  /// Record the energy ledger (increases the cost by about half).
  bool ledger = true;
  /// Floating-point precision of symplectic Euler; see docs/precision.md.
  Precision precision = Precision::double_precision;
  Layout layout = Layout::fastest;  ///< memory layout of the springs for symplectic Euler
  /// Threads for symplectic Euler; 0: chosen by the size of the body. Never changes the result.
  std::uint32_t threads = 1;
  /// The surface at which the body touches obstacles; none: its own nodes, which in a coarse level
  /// lie deep inside the base's surface. See contact_skin.
  std::shared_ptr<const ContactSkin> skin = nullptr;
  /// The nodes that are held. Not a row of the options: scripts give it with the model's nodes.
  std::vector<Anchor> anchors = {};
  /// Ends the run this long after the first contact [s]; none: at the end of the scenario. Not an
  /// option of scripts.
  std::optional<double> stop_after_contact = std::nullopt;
  Progress* progress = nullptr;
};
constexpr auto option_rows(const RunOptions*) {
  return std::tuple(
      option("integrator", &RunOptions::integrator, "time integration scheme"),
      nested(&RunOptions::solver),
      option("step", &RunOptions::step, "time step")
          .within(1e-15, 100)
          .in(Dimension::time)
          .by_default("safety times the predicted stable step; 1 ms for the implicit schemes"),
      option("safety", &RunOptions::safety, "step as a fraction of the predicted stable step")
          .within(1e-6, 1),
      option("precision", &RunOptions::precision,
             "floating-point precision; only symplectic_euler supports \"single\", and other "
             "integrators refuse it"),
      option("layout", &RunOptions::layout, "memory layout of the springs for symplectic_euler"),
      option("sleep", &RunOptions::sleep,
             "a body in contact sleeps, at no cost, once the mean speed of its nodes stays below "
             "this fraction of the speed after a fall through its own size; 0: never")
          .within(0, 1),
      option("volumes", &RunOptions::volumes,
             "whether the corners of the model resist inversion, in the explicit schemes; they are "
             "watched and reported in any case"),
      option("frame_rate", &RunOptions::frame_rate,
             "frames stored per simulated second; 0: only the first and the last")
          .within(0, 1e6),
      option("ledger", &RunOptions::ledger, "record the energy ledger"));
}

inline constexpr const char* kThreadsHelp =
    "number of threads; 0: all cores; never changes a result";

/// Two nodes of a spring that moved past each other: the spring inverted between two checks of the
/// body, relative to the rotation of the whole body.
struct Crossing {
  std::uint32_t a = 0;  ///< node
  std::uint32_t b = 0;  ///< node
  double time = 0;      ///< of the check that found it [s]
};

/// Whether the corners of the model resist inversion in a run with these options.
bool corners_resist(const MassSpringModel& model, const RunOptions& options);

struct Frame {
  double time = 0;      ///< [s]
  std::vector<Vec3> x;  ///< [m]
};

/// What an anchor does to the body between two frames.
struct AnchorLoad {
  Vec3 force = Vec3::Zero();   ///< on the body, mean since the frame before [N]
  Vec3 torque = Vec3::Zero();  ///< about the pivot of the anchor, mean [N m]
  double work = 0;             ///< since the start [J]
};

/// One run of one model: deterministic for any number of threads.
struct Trajectory {
  double step = 0;            ///< at rest [s]
  double shortest_step = 0;   ///< while the body was strongly strained [s]
  double predicted_step = 0;  ///< stable step predicted for the model [s]
  double undamped_step = 0;   ///< the same without damping [s]
  /// What determines `step`. While springs or corners are strongly strained, they determine
  /// shortest_step.
  StepBound limited_by = StepBound::springs;
  std::uint64_t steps = 0;
  /// Spring evaluations in all steps and iterations: the deterministic measure of cost. (A sparse
  /// factorization counts as one pass.)
  std::uint64_t spring_updates = 0;
  /// Steps in which the solver of backward Euler did not reach its tolerance.
  std::uint64_t unconverged_steps = 0;
  double simulated = 0;                 ///< [s]; below the duration if a stop rule ended the run
  double wall_seconds = 0;              ///< measured; never part of a result that must repeat
  double planning_seconds = 0;          ///< of these, the time before the first step (plan_runs)
  double processor_seconds = 0;         ///< of the calling thread from the first step on; measured
  std::vector<Frame> frames;            ///< at the frame times, first and last included
  std::vector<std::uint32_t> anchored;  ///< nodes that anchors hold or pull
  std::vector<LedgerEntry> ledger;      ///< one per frame; empty if not requested
  /// By frame, then by anchor; those of the first frame are 0. Empty without anchors.
  std::vector<std::vector<AnchorLoad>> anchor_loads;
  std::optional<double> first_contact;  ///< [s]
  std::optional<double> asleep_since;   ///< [s]; from then on it was not advanced
  /// For a model without corners: the first inverted spring. From then on, the deformation near it
  /// is not physical.
  std::optional<Crossing> first_crossing;
  Inversions inversions;              ///< of corners, during the run
  std::uint32_t inverted_at_end = 0;  ///< corners inside out in the final state
  State final;
};

/// Data shared by the runs of one model from any start; may be shared between threads.
struct RunPlan {
  std::shared_ptr<const StepLimit> limit;             ///< never null
  std::shared_ptr<const FastModel> layout = nullptr;  ///< for symplectic Euler
};
/// Valid for all runs with these options and obstacles. Throws InputError for a wrong model,
/// scenario or option.
RunPlan plan_runs(const MassSpringModel& model, const Scenario& scenario,
                  const RunOptions& options);

/// Runs the model under the scenario. The step is `safety` times the predicted one, shortened so
/// that the duration is a whole number of steps, or exactly the one given. Frames are at exactly
/// the frame times, interpolated linearly between steps; ledger entries are those of the last step
/// before. Throws InputError for a wrong model, scenario or option, UnstableError naming node and
/// time as soon as a coordinate stops being finite or the energy grows without a source,
/// TunnelError as soon as a node has gone through a box.
Trajectory run(const MassSpringModel& model, const Scenario& scenario,
               const RunOptions& options = {});
/// Starts from the given positions and velocities instead of the scenario's throw.
Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options);
/// Uses the plan made for this model, these obstacles and these options.
Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan);

/// The distance defined by Scenario::measure_from [m], from the displacement of the centre of mass.
double measured_distance(const Scenario& scenario, const Vec3& first_center,
                         const Vec3& final_center);

}  // namespace springlod::sim
