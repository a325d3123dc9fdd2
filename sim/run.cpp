#include "sim/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "model/error.hpp"
#include "sim/contact.hpp"
#include "sim/crossing_watch.hpp"
#include "sim/energy_watch.hpp"
#include "sim/stepper.hpp"

namespace springlod {
namespace {

// Steps between two looks at the whole body (energy, crossings, stop rule, progress) [steps]. One
// look costs some 0.7 of an explicit step, 4 % of a run; a step at ten times the limit multiplies
// speeds by 400 a step, so that 16 of them still stay far from overflow.
constexpr std::uint64_t kLookEvery = 16;

// A step is not longer than this part of the duration [1], so that a body without any stiffness has
// a trajectory too.
constexpr double kLongestStep = 0.01;

// Schemes without a limit take steps that follow contacts and the swing of whole bodies [s].
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
  if (!(std::isfinite(options.frame_rate) && options.frame_rate >= 0))
    throw InputError(
        fmt::format("run: frame_rate = {} must be 0 or more frames a second", options.frame_rate));
}

double default_step(const RunOptions& options, double predicted, double duration) {
  double longest = std::min(options.safety * predicted, kLongestStep * duration);
  if (is_implicit(options.integrator)) longest = std::min(longest, kImplicitStep);
  return duration / std::ceil(duration / longest);
}

/// Whether the centre of mass has been slow for long enough.
class StopWatch {
 public:
  explicit StopWatch(const std::optional<StopRule>& rule) : rule_(rule) {}
  bool look(const Stepper& body) {
    if (!rule_) return false;
    if (body.center_velocity().norm() >= rule_->speed) last_fast_ = body.time();
    return body.time() - last_fast_ >= rule_->hold;
  }

 private:
  std::optional<StopRule> rule_;
  double last_fast_ = 0;
};

/// Keeps what is asked for at the frame times.
class Recorder {
 public:
  Recorder(double frame_rate, bool ledger, Trajectory& trajectory)
      : rate_(frame_rate), ledger_(ledger), trajectory_(&trajectory) {}

  /// All frames that fall into the step that `body` is about to take.
  void record(const Stepper& body, double step) {
    while (next_time() < body.time() + step) {
      keep(next_time(), body);
      ++count_;
    }
  }
  /// Steps after which the next frame falls into the step that follows; 1 or more.
  std::uint64_t steps_to_next(double time, double step) const {
    const double steps = std::floor((next_time() - time) / step);
    if (!(steps > 1)) return 1;
    return steps < kFar ? static_cast<std::uint64_t>(steps) : static_cast<std::uint64_t>(kFar);
  }
  /// The last state, unless it is a frame already.
  void record_end(const Stepper& body, double step) {
    // Steps and frame times are rounded differently: what lies this close is the same instant.
    const double same = 1e-6 * step;
    auto& frames = trajectory_->frames;
    if (!frames.empty() && frames.back().time > body.time() - same) {
      frames.pop_back();
      if (ledger_) trajectory_->ledger.pop_back();
    }
    keep(body.time(), body);
  }

 private:
  double next_time() const {
    if (count_ == 0) return 0;
    return rate_ > 0 ? static_cast<double>(count_) / rate_
                     : std::numeric_limits<double>::infinity();
  }
  void keep(double time, const Stepper& body) {
    trajectory_->frames.push_back({time, body.positions_at(time)});
    if (ledger_) trajectory_->ledger.push_back(body.ledger_entry());
  }

  static constexpr double kFar = 1e9;  // steps: more than anyone asks for at once

  double rate_;
  bool ledger_;
  Trajectory* trajectory_;
  std::uint64_t count_ = 0;
};

void integrate(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const StepLimit& limit, Trajectory& trajectory) {
  const double step = trajectory.step;
  // A duration that is a whole number of steps must not get one more from rounding.
  const auto last_step = static_cast<std::uint64_t>(std::ceil(scenario.duration / step - 1e-6));
  const std::unique_ptr<Stepper> stepper = make_stepper(model, scenario, start, step,
                                                        {.integrator = options.integrator,
                                                         .solver = options.solver,
                                                         .ledger = options.ledger,
                                                         .precision = options.precision,
                                                         .threads = options.threads});
  Stepper& body = *stepper;
  Recorder recorder(options.frame_rate, options.ledger, trajectory);
  StopWatch stop(scenario.stop);
  Task task(options.progress, "simulate", last_step);

  body.prepare();
  EnergyWatch watch(model, body, step, limit);
  CrossingWatch crossings(model, start);
  const Vec3 weight = scenario.gravity * std::accumulate(model.mass.begin(), model.mass.end(), 0.0);
  const Vec3 first_center = body.center_of_mass();
  while (body.step_number() < last_step) {
    if (body.step_number() % kLookEvery == 0) {
      watch.look(body, weight.dot(body.center_of_mass() - first_center));
      if (!trajectory.first_crossing) trajectory.first_crossing = crossings.look(body.state());
      if (stop.look(body)) break;
      task.advance(std::min(kLookEvery, last_step - body.step_number()));
    }
    recorder.record(body, step);
    const std::uint64_t next_look = kLookEvery - body.step_number() % kLookEvery;
    body.advance(std::min(
        {next_look, last_step - body.step_number(), recorder.steps_to_next(body.time(), step)}));
  }
  watch.look(body, weight.dot(body.center_of_mass() - first_center));
  recorder.record_end(body, step);

  trajectory.final = body.state();
  trajectory.first_contact = body.first_contact();
  trajectory.steps = body.step_number();
  trajectory.unconverged_steps = body.unconverged_steps();
  trajectory.spring_updates = body.spring_updates();
  trajectory.simulated = body.time();
}

}  // namespace

Trajectory run(const MassSpringModel& model, const Scenario& scenario, const RunOptions& options) {
  validate(model);
  validate(scenario);
  return run(model, scenario, initial_state(model, scenario.start), options);
}

Trajectory run(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options) {
  validate(model);
  validate(scenario);
  validate(options);
  if (start.x.size() != model.node_count() || start.v.size() != model.node_count())
    throw InputError(fmt::format("run: a start of {} positions and {} velocities for {} nodes",
                                 start.x.size(), start.v.size(), model.node_count()));
  const auto begin = std::chrono::steady_clock::now();
  const StepLimit limit = step_limit(model, scenario, options.integrator);
  Trajectory trajectory;
  trajectory.predicted_step = limit.step;
  trajectory.step = options.step.value_or(default_step(options, limit.step, scenario.duration));
  integrate(model, scenario, start, options, limit, trajectory);
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
    throw InputError(fmt::format("scenario: measure_from = \"{}\" is the name of no obstacle",
                                 scenario.measure_from));
  return surface_point(*obstacle, final_center).distance;
}

Vec3 center_of_mass(const MassSpringModel& model, const std::vector<Vec3>& x) {
  Vec3 moment = Vec3::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    moment += model.mass[i] * x[i];
    mass += model.mass[i];
  }
  return moment / mass;
}

}  // namespace springlod
