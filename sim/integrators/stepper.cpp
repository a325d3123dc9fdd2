#include "sim/integrators/stepper.hpp"

#include <numeric>

namespace springlod::sim {

Stepper::Stepper(const MassSpringModel& model, const Scenario& scenario, const State& start,
                 double step, const ContactSkin* skin, const std::vector<Anchor>& anchors)
    : model_(&model),
      gravity_(scenario.gravity),
      step_(step),
      x_(start.x),
      obstacle_count_(scenario.obstacles.size()),
      held_(model, anchors, start.x),
      anchor_springs_(model, anchors, start.x),
      anchor_forces_(anchors.size()),
      points_(skin != nullptr ? ContactPoints(model, *skin, &held_) : ContactPoints(model, &held_)),
      finder_(points_, scenario.obstacles, start.x),
      walls_(points_, scenario.obstacles, start.x),
      total_mass_(std::accumulate(model.mass.begin(), model.mass.end(), 0.0)),
      first_center_(center_of_mass()) {}

void StepByStep::advance(std::uint64_t steps) {
  for (std::uint64_t i = 0; i < steps; ++i) {
    if (!first_contact_ && !contacts_.empty()) first_contact_ = time();
    commit();
    walls_.check(x_, time(), step_);
    prepare();
  }
  if (!first_contact_ && !contacts_.empty()) first_contact_ = time();
}

void Stepper::move_anchors(std::uint64_t n) {
  held_.move_to(time_of(n));
  anchor_springs_.move_to(time_of(n));
}

void Stepper::take(const InversionLog& log) {
  inversions_.most = log.most();
  if (log.first() && !inversions_.first)
    inversions_.first =
        Inversion{log.first()->corner, log.first()->place, time_of(log.first()->step)};
}

void StepByStep::note_inversions(const std::vector<std::uint32_t>& now,
                                 const std::vector<std::uint32_t>& late) {
  log_.note(n_, now, late,
            [&](std::uint32_t corner) { return x_[model_->corners[corner].node[0]]; });
  take(log_);
}

Vec3 Stepper::center_of_mass() const {
  return springlod::center_of_mass(*model_, x_);
}

Vec3 Stepper::center_velocity() const {
  return springlod::center_of_mass(*model_, step_velocities());
}

double Stepper::gravity_energy() const {
  return -total_mass_ * gravity_.dot(center_of_mass() - first_center_);
}

double Stepper::kinetic_of_step(std::uint32_t* fastest) const {
  const std::vector<Vec3>& v = step_velocities();
  double sum = 0;
  double most = -1;
  for (std::uint32_t i = 0; i < v.size(); ++i) {
    const double kinetic = 0.5 * model_->mass[i] * v[i].squaredNorm();
    sum += kinetic;
    if (kinetic > most) {
      most = kinetic;
      *fastest = i;
    }
  }
  return sum;
}

}  // namespace springlod::sim
