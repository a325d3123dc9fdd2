#include "sim/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/processor_time.hpp"
#include "sim/fast/fast_model.hpp"
#include "sim/integrators/dilatation.hpp"
#include "sim/integrators/step_limit.hpp"
#include "sim/run/integration.hpp"

namespace springlod::sim {
namespace {

// Longest step as a fraction of the duration [1], so that a body without any stiffness has a
// trajectory too.
constexpr double kLongestStep = 0.01;

// Step of schemes without a stability limit: short enough to resolve contacts and the slow
// vibration of bodies [s].
constexpr double kImplicitStep = 1e-3;

void validate(const RunOptions& options) {
  if (options.step && !(std::isfinite(*options.step) && *options.step > 0))
    throw InputError(
        fmt::format("run: step = {} must be a finite number of seconds above 0", *options.step));
  if (!(options.safety > 0 && options.safety <= 1))
    throw InputError(fmt::format("run: safety = {} must lie in (0, 1]", options.safety));
  if (!(options.solver.tolerance > 0 && options.solver.tolerance < 1))
    throw InputError(
        fmt::format("run: tolerance = {} must lie in (0, 1)", options.solver.tolerance));
  if (!(options.sleep >= 0 && options.sleep < 1))
    throw InputError(fmt::format("run: sleep = {} must lie in [0, 1); 0: never", options.sleep));
  if (!(std::isfinite(options.frame_rate) && options.frame_rate >= 0))
    throw InputError(fmt::format("run: frame_rate = {} must be 0 or more frames per second",
                                 options.frame_rate));
}

void require_known_precision(const RunOptions& options) {
  if (options.precision == Precision::double_precision || choice_of(options.integrator).traits.fast)
    return;
  throw InputError(fmt::format(
      "run: integrator = \"{}\" computes in double precision only; leave out precision = \"{}\", "
      "or use integrator = \"{}\"",
      to_string(options.integrator), to_string(options.precision),
      to_string(Integrator::symplectic_euler)));
}

void require_known_forces(const MassSpringModel& model, Integrator integrator) {
  if (model.dilatation.empty() || knows_terms(integrator)) return;
  throw InputError(fmt::format(
      "run: integrator = \"{}\" knows springs only, and the model has the dilatation terms of a "
      "Poisson's ratio other than {}; use symplectic_euler, velocity_verlet or runge_kutta_4",
      to_string(integrator), kSpringPoisson));
}

void require_step_count(double duration, double step) {
  constexpr double kMost = 1e15;  // more would take years
  if (step > duration)
    throw InputError(
        fmt::format("run: step = {:g} s is longer than the duration of {:g} s; take a shorter step",
                    step, duration));
  if (duration / step > kMost)
    throw InputError(fmt::format(
        "run: step = {:g} s makes {:.2g} steps of the duration of {:g} s; take a longer step", step,
        duration / step, duration));
}

/// The frames are kept in memory: a typing error in the rate must not fill it.
void require_few_frames(double duration, double frame_rate, std::size_t nodes) {
  constexpr double kMost = 4e9;  // [bytes]
  const double frames = duration * frame_rate;
  const double size = frames * static_cast<double>(nodes * sizeof(Vec3) + sizeof(LedgerEntry));
  if (size > kMost)
    throw InputError(fmt::format(
        "run: frame_rate = {:g} makes {:.3g} frames in {:g} s, {:.3g} GB for {} nodes; use at most "
        "{:.3g}",
        frame_rate, frames, duration, size / 1e9, nodes, frame_rate * kMost / size));
}

struct ChosenStep {
  double step = 0;  // [s]
  StepBound limited_by = StepBound::springs;
};

ChosenStep default_step(const RunOptions& options, const StepLimit& limit, double duration) {
  ChosenStep longest{options.safety * limit.step, limit.limited_by()};
  const auto shorten = [&](double step, StepBound bound) {
    if (step < longest.step) longest = {step, bound};
  };
  if (is_implicit(options.integrator)) shorten(kImplicitStep, StepBound::scheme);
  shorten(kLongestStep * duration, StepBound::duration);
  return {duration / std::ceil(duration / longest.step), longest.limited_by};
}

ChosenStep choose_step(const RunOptions& options, const StepLimit& limit, double duration) {
  if (options.step) return {*options.step, StepBound::asked};
  return default_step(options, limit, duration);
}

}  // namespace

bool corners_resist(const MassSpringModel& model, const RunOptions& options) {
  return options.volumes && !is_implicit(options.integrator) && !model.corners.empty();
}

Trajectory run(const MassSpringModel& model, const Scenario& scenario, const RunOptions& options) {
  validate(model);
  return run(model, scenario, initial_state(model, scenario.start), options);
}

RunPlan plan_runs(const MassSpringModel& model, const Scenario& scenario,
                  const RunOptions& options) {
  validate(model);
  validate(scenario);
  validate(options);
  validate(options.anchors, model);
  require_known_precision(options);
  require_known_forces(model, options.integrator);
  RunPlan plan{.limit = std::make_shared<const StepLimit>(step_limit(model, options.integrator))};
  if (choice_of(options.integrator).traits.fast)
    plan.layout = make_fast_model(model, options.precision, options.layout);
  return plan;
}

Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  const RunPlan plan = plan_runs(model, scenario, options);
  const double planning =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  Trajectory trajectory = run(model, scenario, start, options, plan);
  trajectory.wall_seconds += planning;
  trajectory.planning_seconds = planning;
  return trajectory;
}

Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan) {
  validate(scenario);
  validate(options);
  if (start.x.size() != model.node_count() || start.v.size() != model.node_count())
    throw InputError(fmt::format("run: a start of {} positions and {} velocities for {} nodes",
                                 start.x.size(), start.v.size(), model.node_count()));
  const auto begin = std::chrono::steady_clock::now();
  Trajectory trajectory;
  trajectory.predicted_step = plan.limit->step;
  trajectory.undamped_step = plan.limit->without_damping;
  const ChosenStep chosen = choose_step(options, *plan.limit, scenario.duration);
  trajectory.step = chosen.step;
  trajectory.limited_by = chosen.limited_by;
  trajectory.anchored = nodes_of(options.anchors);
  require_step_count(scenario.duration, trajectory.step);
  require_few_frames(scenario.duration, options.frame_rate, model.node_count());
  const double processor_begin = processor_seconds();
  integrate(model, scenario, start, options, plan, trajectory);
  trajectory.processor_seconds = processor_seconds() - processor_begin;
  trajectory.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return trajectory;
}

double measured_distance(const Scenario& scenario, const Vec3& first_center,
                         const Vec3& final_center) {
  if (scenario.measure_from.empty()) return (final_center - first_center).head<2>().norm();
  const auto obstacle =
      std::find_if(scenario.obstacles.begin(), scenario.obstacles.end(),
                   [&](const Obstacle& o) { return o.name == scenario.measure_from; });
  if (obstacle == scenario.obstacles.end())
    throw InputError(fmt::format("scenario: measure_from = \"{}\" is not the name of an obstacle",
                                 scenario.measure_from));
  return surface_distance(*obstacle, final_center).distance;
}

}  // namespace springlod::sim
