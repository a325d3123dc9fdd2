#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "model/chain.hpp"
#include "sim/held/anchor.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/step_bound.hpp"

namespace springlod::sim {

/// Verdict on one point of a stability map: the last of these that applies.
enum class Verdict {
  stable,       ///< none of the others
  inaccurate,   ///< its error is above kInaccurate
  drifting,     ///< the scheme itself gained or lost more than kDrifting of the energy
  off_design,   ///< the level no longer represents the body: the error of its frequencies is above
                ///< kOffDesign
  crossed,      ///< springs or corners were inverted: nodes moved past each other
  unconverged,  ///< the solver of backward Euler stopped before it reached its tolerance
  runaway,      ///< the energy rose by kRunaway: the state is finite but meaningless
  diverged,     ///< non-finite state or growing energy
  mechanism,    ///< nodes move without resistance: not run
};

inline constexpr Choice<Verdict> kVerdicts[] = {
    {Verdict::stable, "stable", "none of the others"},
    {Verdict::inaccurate, "inaccurate",
     "the mean distance from the reference run is over 10 % of its displacement"},
    {Verdict::drifting, "drifting", "the scheme gained or lost over 10 % of the energy"},
    {Verdict::off_design, "off_design", "the mean error of the level's frequencies is over 25 %"},
    {Verdict::crossed, "crossed", "springs or corners were inverted"},
    {Verdict::unconverged, "unconverged", "the solver did not reach its tolerance"},
    {Verdict::runaway, "runaway", "the energy more than doubled, although the state stayed finite"},
    {Verdict::diverged, "diverged", "non-finite state"},
    {Verdict::mechanism, "mechanism", "nodes move without resistance: not run"}};
constexpr ChoiceTable<Choice<Verdict>> choices(Verdict) {
  return {"verdict", kVerdicts};
}

/// Mean distance from the reference over its mean displacement [1]. A tenth is visible.
inline constexpr double kInaccurate = 0.1;
/// Energy gained or lost by the scheme over the energy at the start [1].
inline constexpr double kDrifting = 0.1;
/// Relative energy gain above which a run counts as unstable, even with a finite state [1].
inline constexpr double kRunaway = 1;
/// Mean relative error of a level's lowest frequencies against the base's [1]. Merging without
/// calibration stays below it for two levels of the paper's bodies (5 to 17 %).
inline constexpr double kOffDesign = 0.25;

struct StabilityOptions {
  std::vector<std::uint32_t> levels = {};  ///< empty: all
  /// Young's modulus of the stiff part over that of the soft one: see with_stiffness_ratio.
  std::vector<double> ratios{1, 10, 100, 1e3, 1e4, 1e5};
  /// Levels change with the ratio as if they were merged again from the rescaled base; false: they
  /// stay unchanged, which shows how far a level may be used from its design ratio.
  bool remake_levels = true;
  /// By default all, without those that do not know the forces of the chain (knows_terms); if any
  /// of these is named in another list, that is an error.
  std::vector<Integrator> integrators = all_choices<Integrator>();
  /// Numbers of iterations of XPBD and projective dynamics, each combined with each step; 0: the
  /// default of the scheme.
  std::vector<std::uint32_t> iterations{0};
  /// True if springs keep their damping. Without damping, every loss of energy is numerical, and
  /// the explicit limit falls with the square root of the ratio instead of the ratio.
  bool damping = false;
  /// Steps of explicit schemes, relative to their predicted stability limits [1].
  std::vector<double> steps{0.5, 0.9, 1.1, 2, 5, 20};
  /// Steps of backward Euler, in periods of the body's slowest mode [1].
  std::vector<double> implicit_steps{0.003, 0.01, 0.03, 0.1};
  /// Steps of XPBD and projective dynamics, which are cheaper, in periods of the slowest mode [1].
  std::vector<double> sweep_steps{0.0003, 0.001, 0.003, 0.01, 0.03};
  /// Steps for all schemes, in place of these [s].
  std::vector<double> absolute_steps = {};
  /// Duration of each run, in periods of the body's slowest mode [1].
  double periods = 1;
  std::optional<double> duration = {};  ///< the same in seconds
  std::vector<Anchor> anchors = {};     ///< of the base
  std::uint32_t threads = 0;            ///< 0: all cores. Never changes the result
  std::uint64_t seed = 1;               ///< of the search for frequencies
  Progress* progress = nullptr;
};
constexpr auto option_rows(const StabilityOptions*) {
  using Options = StabilityOptions;
  return std::tuple(
      option("levels", &Options::levels, "levels to map; 0 is the base")
          .within(0, 1000)
          .by_default("all"),
      option(
          "ratios", &Options::ratios,
          "Young's modulus of the stiff part / that of the softest material, which is unchanged; "
          "the stiff part of a body of one material is the half beyond the centre of mass")
          .within(1e-9, 1e9),
      option("remake_levels", &Options::remake_levels,
             "change the levels with the ratio, as if merged again from the base; false: only the "
             "base"),
      option("damping", &Options::damping,
             "whether springs keep their damping; without it, every energy loss is numerical"),
      option("integrators", &Options::integrators, "integrators to map, as for run")
          .by_default("all that know the forces of the chain"),
      option("iterations", &Options::iterations,
             "iterations per step of xpbd and projective_dynamics; each number is run")
          .within(1, 10000)
          .by_default("the default of each integrator"),
      option("steps", &Options::steps, "step lengths for explicit integrators / predicted limit")
          .within(1e-3, 1e3),
      option("implicit_steps", &Options::implicit_steps,
             "step lengths for backward Euler / period of the slowest mode")
          .within(1e-5, 1e3),
      option("sweep_steps", &Options::sweep_steps,
             "step lengths for xpbd and projective_dynamics / period of the slowest mode")
          .within(1e-6, 1e3),
      option(
          "absolute_steps", &Options::absolute_steps,
          "step lengths for all integrators, instead of steps, implicit_steps and sweep_steps [s]")
          .within(1e-9, 100)
          .in(Dimension::time)
          .by_default("none"),
      option("periods", &Options::periods, "length of each run in periods of the slowest mode")
          .within(1e-3, 1e3),
      option("duration", &Options::duration, "length of each run")
          .within(1e-9, 1e5)
          .in(Dimension::time)
          .by_default("from periods"),
      option("threads", &Options::threads,
             "number of threads; 0: all cores; never changes a result")
          .within(0, 1024),
      option("seed", &Options::seed, "seed of the search for frequencies"));
}

/// One level at one ratio: data common to all its points.
struct StabilityBody {
  std::uint32_t level = 0;
  double ratio = 1;
  std::uint32_t nodes = 0;
  std::uint32_t springs = 0;
  double period = 0;    ///< period of the slowest mode of the base [s]
  double duration = 0;  ///< of each run [s]
  /// Stability limit of symplectic Euler, of the nodes that are not held [s]: the map shows it as
  /// the predicted limit.
  double limit = 0;
  StepBound limited_by = StepBound::springs;
  /// Mean relative error of the lowest frequencies against those of the base at the same ratio [1].
  double frequency_error = 0;
  /// Estimated error of the reference: its distance from a run with twice the step, divided by 3;
  /// in the unit of the error of a point [1].
  double reference_error = 0;
  std::uint32_t loose_nodes = 0;   ///< number of nodes in mechanisms
  std::uint32_t loosest_node = 0;  ///< the worst of them, if there are any
};

struct StabilityPoint {
  std::uint32_t body = 0;  ///< number in StabilityMap::bodies
  Integrator integrator = Integrator::symplectic_euler;
  std::uint32_t iterations = 0;  ///< of implicit schemes, at most
  double step = 0;               ///< [s]
  double limit = 0;       ///< stability limit of this scheme; of symplectic Euler if implicit [s]
  bool stable = false;    ///< completed, and the energy never rose by kRunaway
  bool finished = false;  ///< completed: the numbers below are valid
  Verdict verdict = Verdict::stable;
  std::optional<double> diverged_at;  ///< [s]
  /// The worst node of a run that diverged, of an inverted spring or of a mechanism.
  std::optional<std::uint32_t> node;
  // Of finished runs:
  double energy_drift = 0;  ///< largest signed change of the ledger's total without
                            ///< lost_scheme / first total and work of anchors [1]
  /// RMS distance of the nodes from those of the reference over the RMS of its displacement from
  /// the start, both weighted by mass, over kSamples common times [1].
  double error = 0;
  double cost = 0;  ///< spring updates per simulated second
  std::uint64_t unconverged_steps = 0;
  double wall_seconds = 0;  ///< measured; kept out of results
};

struct StabilityMap {
  std::string stiff_part;              ///< what is stiff
  std::vector<StabilityBody> bodies;   ///< by level, ratios ascending
  std::vector<StabilityPoint> points;  ///< by body, then by scheme, steps ascending
};

/// Runs every level at every stiffness ratio with every scheme and step, and compares each run with
/// a reference of the same model: velocity Verlet at a quarter of its limit. The number of threads
/// changes no bit of the result. Throws InputError for options out of range and for a chain whose
/// base has no mode, and InterruptedError from `progress`.
StabilityMap stability_map(const LodChain& chain, const StabilityOptions& options = {});

}  // namespace springlod::sim
