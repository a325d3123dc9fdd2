#include "sim/integrators/leapfrog.hpp"

#include <algorithm>

#include "sim/integrators/contact_losses.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {

Leapfrog::Leapfrog(const MassSpringModel& model, const Scenario& scenario, const State& start,
                   double step, const StepperOptions& options)
    : StepByStep(model, scenario, start, step, options.skin.get()),
      integrator_(options.integrator),
      with_ledger_(options.ledger),
      v_minus_(start.v),
      v_plus_(start.v),
      v_damping_(start.v),
      force_(start.x.size()),
      damping_force_(start.x.size(), Vec3::Zero()) {
  find_forces(false);
  for (std::size_t i = 0; i < x_.size(); ++i)
    v_minus_[i] -= 0.5 * step_ * (force_[i] / model.mass[i] + gravity_);
}

void Leapfrog::find_forces(bool with_damping) {
  const std::vector<Vec3>& w =
      n_ > 0 && integrator_ == Integrator::symplectic_euler ? v_minus_ : v_damping_;
  std::fill(force_.begin(), force_.end(), Vec3::Zero());
  if (with_damping) {
    std::fill(damping_force_.begin(), damping_force_.end(), Vec3::Zero());
    add_spring_forces<true>(*model_, x_, w, force_, damping_force_);
  } else {
    add_spring_forces<false>(*model_, x_, w, force_, damping_force_);
  }
  std::swap(contacts_, contacts_before_);
  finder_.find(x_, w, contacts_);
  keep_stick_springs(contacts_before_, contacts_);
  add_normal_forces(points_, contacts_, force_);
}

void Leapfrog::prepare() {
  find_forces(with_ledger_);
  for (std::size_t i = 0; i < x_.size(); ++i)
    v_plus_[i] = v_minus_[i] + step_ * (force_[i] / model_->mass[i] + gravity_);
  apply_friction(points_, step_, contacts_, v_plus_);
  if (with_ledger_ && n_ > 0) book_half_step(v_minus_, -step_);
}

void Leapfrog::commit() {
  if (with_ledger_) book_half_step(v_plus_, step_);
  for (std::size_t i = 0; i < x_.size(); ++i) x_[i] += step_ * v_plus_[i];
  if (integrator_ == Integrator::velocity_verlet)
    for (std::size_t i = 0; i < x_.size(); ++i)
      v_damping_[i] = v_plus_[i] + 0.5 * (v_plus_[i] - v_minus_[i]);
  std::swap(v_minus_, v_plus_);
  ++n_;
}

void Leapfrog::book_half_step(const std::vector<Vec3>& v, double to_neighbour) {
  double damping = 0;
  for (std::size_t i = 0; i < x_.size(); ++i) damping -= damping_force_[i].dot(v[i]);
  losses_.lost_damping += 0.5 * step_ * damping;
  for (const Contact& c : contacts_)
    book_contact(c, points_.mass(c.point), step_, points_.interpolate(c.point, v), to_neighbour,
                 losses_);
}

std::vector<Vec3> Leapfrog::positions_at(double time) const {
  std::vector<Vec3> x = x_;
  const double ahead = time - this->time();
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += ahead * v_plus_[i];
  return x;
}

State Leapfrog::state() const {
  State state{x_, v_minus_, time()};
  for (std::size_t i = 0; i < x_.size(); ++i) state.v[i] = 0.5 * (v_minus_[i] + v_plus_[i]);
  return state;
}

LedgerEntry Leapfrog::ledger_entry() const {
  LedgerEntry entry = losses_;
  entry.time = time();
  for (std::size_t i = 0; i < x_.size(); ++i)
    entry.kinetic += 0.5 * model_->mass[i] * v_minus_[i].dot(v_plus_[i]);
  entry.elastic = elastic_energy(*model_, x_);
  entry.gravity = gravity_energy();
  entry.contact = contact_energy(contacts_);
  return entry;
}

}  // namespace springlod::sim
