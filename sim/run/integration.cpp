#include "sim/run/integration.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

#include "sim/integrators/stepper.hpp"
#include "sim/run/energy_watch.hpp"
#include "sim/run/recorder.hpp"
#include "sim/run/rest_watch.hpp"
#include "sim/run/spring_watch.hpp"
#include "sim/run/step_watch.hpp"

namespace springlod::sim {
namespace {

// Steps between two looks at the whole body [steps], which cost as much as some three of them. A
// step at twice the limit multiplies speeds by 14 a step, which stays finite in double precision.
constexpr std::uint64_t kLookEvery = 64;
// The same while springs are strained hard: what is stable may change within few steps.
constexpr std::uint64_t kLookOftenEvery = 16;

/// One run under way.
class Integration {
 public:
  Integration(const MassSpringModel& model, const Scenario& scenario, const State& start,
              const RunOptions& options, const RunPlan& plan, Trajectory& trajectory)
      : duration_(scenario.duration),
        first_step_(trajectory.step),
        trajectory_(&trajectory),
        body_(choice_of(options.integrator)
                  .make(model, scenario, start, trajectory.step, options, plan)),
        recorder_(options.frame_rate, options.ledger, trajectory),
        weight_(scenario.gravity * std::accumulate(model.mass.begin(), model.mass.end(), 0.0)),
        first_center_(body_->center_of_mass()),
        springs_(model, start),
        stop_(scenario.stop),
        sleep_(model, scenario, options.sleep),
        task_(options.progress, "simulate", steps_left()) {
    body_->prepare();
    energy_.emplace(model, *body_, options.precision, trajectory.step, *plan.limit);
    if (!options.step && choice_of(options.integrator).traits.fast)
      step_.emplace(model, *plan.limit, trajectory.step);
  }

  void go() {
    bool asleep = false;
    while (steps_left() > 0) {
      if (body_->step_number() >= next_look_) {
        asleep = sleep_.look(*body_);
        if (look() || asleep) break;
      }
      recorder_.record(*body_);
      body_->advance(std::min(
          {next_look_ - body_->step_number(), steps_left(), recorder_.steps_to_next(*body_)}));
    }
    look_at_energy();
    finish(asleep ? duration_ : body_->time());
  }

 private:
  /// A duration that is a whole number of steps must not get one more from rounding.
  std::uint64_t steps_left() const {
    const double steps = std::ceil((duration_ - body_->time()) / body_->step() - 1e-6);
    return steps > 0 ? static_cast<std::uint64_t>(steps) : 0;
  }

  /// Whether the stop rule ends the run here.
  bool look() {
    look_at_energy();
    springs_.look(body_->state());
    if (stop_.look(*body_)) return true;
    const bool strained = springs_.largest_strain() > StepWatch::kSmallStrain;
    next_look_ = body_->step_number() + (strained ? kLookOftenEvery : kLookEvery);
    if (step_) take_step(step_->step_for(body_->positions(), springs_.largest_strain()));
    report();
    return false;
  }

  void take_step(double step) {
    if (step == body_->step()) return;
    body_->change_step(step);
    trajectory_->shortest_step = std::min(trajectory_->shortest_step, step);
  }

  void look_at_energy() {
    energy_->look(*body_, weight_.dot(body_->center_of_mass() - first_center_));
  }

  void report() {
    const auto done = static_cast<std::uint64_t>(body_->time() / first_step_);
    if (done > reported_) task_.advance(done - reported_);
    reported_ = std::max(reported_, done);
  }

  void finish(double time) {
    recorder_.record_rest(*body_, time);
    recorder_.record_end(*body_, time);
    Trajectory& t = *trajectory_;
    t.final = body_->state();
    t.final.t = time;
    t.first_contact = body_->first_contact();
    t.first_crossing = springs_.first_crossing();
    if (time > body_->time()) t.asleep_since = body_->time();
    t.steps = body_->step_number();
    t.unconverged_steps = body_->unconverged_steps();
    t.spring_updates = body_->spring_updates();
    t.simulated = time;
  }

  double duration_;    // [s]
  double first_step_;  // [s]
  Trajectory* trajectory_;
  std::unique_ptr<Stepper> body_;
  Recorder recorder_;
  Vec3 weight_;  // [N]
  Vec3 first_center_;
  SpringWatch springs_;
  StopWatch stop_;
  SleepWatch sleep_;
  Task task_;
  std::optional<EnergyWatch> energy_;
  std::optional<StepWatch> step_;
  std::uint64_t next_look_ = 0;  // step number
  std::uint64_t reported_ = 0;
};

}  // namespace

void integrate(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan, Trajectory& trajectory) {
  trajectory.shortest_step = trajectory.step;
  Integration(model, scenario, start, options, plan, trajectory).go();
}

}  // namespace springlod::sim
