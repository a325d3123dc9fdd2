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

// Steps between two checks of the whole body [steps]; a check costs about as much as three steps.
// At twice the stability limit, speeds grow by the factor 14 per step and stay finite in double
// precision until the next check.
constexpr std::uint64_t kCheckEvery = 64;
// The same while springs are strongly strained, as the stability limit may then change within a few
// steps, and for schemes that do not look at the body themselves.
constexpr std::uint64_t kCheckOftenEvery = 16;

/// The state with the velocities of the anchors at their nodes.
State held_start(const MassSpringModel& model, State start, const std::vector<Anchor>& anchors) {
  HeldNodes(model, anchors, start.x).put_velocities(start.v);
  return start;
}

/// A run in progress.
class Integration {
 public:
  Integration(const MassSpringModel& model, const Scenario& scenario, const State& start,
              const RunOptions& options, const RunPlan& plan, Trajectory& trajectory)
      : model_(&model),
        duration_(scenario.duration),
        first_step_(trajectory.step),
        fast_(choice_of(options.integrator).traits.fast),
        trajectory_(&trajectory),
        body_(choice_of(options.integrator)
                  .make(model, scenario, held_start(model, start, options.anchors), trajectory.step,
                        options, plan)),
        recorder_(options.frame_rate, options.ledger, trajectory),
        weight_(scenario.gravity * std::accumulate(model.mass.begin(), model.mass.end(), 0.0)),
        first_center_(body_->center_of_mass()),
        springs_(model, start),
        stop_(scenario.stop),
        sleep_(model, scenario, options.sleep, end_of_paths(options.anchors)),
        stop_after_contact_(options.stop_after_contact),
        task_(options.progress, "simulate", steps_left()) {
    body_->prepare();
    energy_.emplace(model, *body_, corners_resist(model, options), options.precision,
                    trajectory.step, *plan.limit);
    if (!options.step && fast_) step_.emplace(model, *plan.limit, trajectory.step);
  }

  void go() {
    bool asleep = false;
    while (steps_left() > 0) {
      if (body_->step_number() >= next_check_) {
        asleep = sleep_.check(*body_);
        if (check() || asleep) break;
      }
      recorder_.record(*body_);
      const std::uint64_t steps = std::min(
          {next_check_ - body_->step_number(), steps_left(), recorder_.steps_to_next(*body_)});
      body_->advance(steps);
      if (body_->stopped()) next_check_ = body_->step_number();
    }
    check_energy();
    finish(asleep ? duration_ : body_->time());
  }

 private:
  /// A duration that is a whole number of steps must not get one more from rounding.
  std::uint64_t steps_left() const {
    const double steps = std::ceil((duration_ - body_->time()) / body_->step() - 1e-6);
    return steps > 0 ? static_cast<std::uint64_t>(steps) : 0;
  }

  /// True if the stop rule ends the run at this step.
  bool check() {
    check_energy();
    springs_.check(body_->state());
    if (stop_.check(*body_) || contact_is_over()) return true;
    const double strain = springs_.largest_strain();
    const bool strained = strain > StepController::kSmallStrain;
    next_check_ = body_->step_number() + (strained || !fast_ ? kCheckOftenEvery : kCheckEvery);
    if (step_)
      take_step(step_->step_for(body_->positions(), {.strain = strain,
                                                     .corner_change = body_->take_corner_change(),
                                                     .step_number = body_->step_number()}));
    watch(strained);
    report();
    return false;
  }

  bool contact_is_over() const {
    return stop_after_contact_ && body_->first_contact() &&
           body_->time() > *body_->first_contact() + *stop_after_contact_;
  }

  /// What the scheme looks for until the next check. A strained body is checked often anyway.
  void watch(bool strained) {
    Stepper::Watch limits{.speed = energy_->safe_speed()};
    if (step_ && !strained) limits.strain = StepController::kSmallStrain;
    if (step_ && step_->corners_may_halve()) limits.corner_change = StepController::kCornerChange;
    body_->watch(limits);
  }

  void take_step(double step) {
    if (step == body_->step()) return;
    body_->change_step(step);
    trajectory_->shortest_step = std::min(trajectory_->shortest_step, step);
  }

  void check_energy() {
    energy_->check(*body_, weight_.dot(body_->center_of_mass() - first_center_));
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
    t.inversions = body_->inversions();
    t.inverted_at_end =
        static_cast<std::uint32_t>(inverted_corners(model_->corners, t.final.x).size());
    if (time > body_->time()) t.asleep_since = body_->time();
    t.steps = body_->step_number();
    t.unconverged_steps = body_->unconverged_steps();
    t.spring_updates = body_->spring_updates();
    t.simulated = time;
  }

  const MassSpringModel* model_;
  double duration_;    // [s]
  double first_step_;  // [s]
  bool fast_;
  Trajectory* trajectory_;
  std::unique_ptr<Stepper> body_;
  Recorder recorder_;
  Vec3 weight_;  // [N]
  Vec3 first_center_;
  SpringCheck springs_;
  StopCriterion stop_;
  RestCriterion sleep_;
  std::optional<double> stop_after_contact_;  // [s]
  Task task_;
  std::optional<EnergyCheck> energy_;
  std::optional<StepController> step_;
  std::uint64_t next_check_ = 0;  // step number
  std::uint64_t reported_ = 0;
};

}  // namespace

void integrate(const MassSpringModel& model, const Scenario& scenario, const State& start,
               const RunOptions& options, const RunPlan& plan, Trajectory& trajectory) {
  trajectory.shortest_step = trajectory.step;
  Integration(model, scenario, start, options, plan, trajectory).go();
}

}  // namespace springlod::sim
