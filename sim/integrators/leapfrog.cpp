#include "sim/integrators/leapfrog.hpp"

#include <algorithm>

#include "sim/correction/corner_law.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {

Leapfrog::Leapfrog(const MassSpringModel& model, const Scenario& scenario, const State& start,
                   double step, const StepperOptions& options)
    : StepByStep(model, scenario, start, step, options.skin.get(), options.anchors),
      integrator_(options.integrator),
      with_ledger_(options.ledger),
      books_scheme_(options.ledger && options.integrator == Integrator::velocity_verlet),
      volumes_(options.volumes),
      v_minus_(start.v),
      v_plus_(start.v),
      v_damping_(start.v),
      force_(start.x.size()),
      damping_force_(start.x.size(), Vec3::Zero()),
      anchor_force_(held_.count(), Vec3::Zero()),
      correction_(model, points_, finder_, obstacle_count_, options.volumes,
                  {.held = &held_, .springs = &anchor_springs_}),
      v_step_(start.v),
      x_next_(start.x),
      v_next_(start.v),
      booked_corners_(volumes_ ? corner_energy(model, start.x) : 0) {
  finder_.find(x_, start.v, x_, contacts_);
  correction_.solver().set(contacts_);
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
    add_internal_forces<true>(*model_, x_, w, force_, damping_force_);
  } else {
    add_internal_forces<false>(*model_, x_, w, force_, damping_force_);
  }
}

void Leapfrog::prepare() {
  find_forces(with_ledger_);
  if (with_ledger_ && n_ > 0) book_damping(v_minus_);
  if (books_scheme_) {
    const double before = elastic_;
    elastic_ = elastic_energy(*model_, x_);
    if (n_ > 0) losses_.lost_scheme += before - elastic_ - half_spring_work();
  }
  for (std::size_t i = 0; i < x_.size(); ++i) {
    v_plus_[i] = v_minus_[i] + step_ * (force_[i] / model_->mass[i] + gravity_);
    x_next_[i] = x_[i] + step_ * v_plus_[i];
    v_next_[i] = v_plus_[i];
  }
  hold_nodes();
  if (with_ledger_) book_end();
  correction_.correct(step_, x_, x_next_, v_next_);
  v_step_ = v_plus_;
  for (const NodeChange& change : correction_.solver().changes())
    v_step_[change.node] += change.displacement / step_;
}

void Leapfrog::hold_nodes() {
  move_anchors(n_ + 1);
  anchor_half_work_ = 0;
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const std::uint32_t i = held_.node(h);
    const Vec3 velocity = (held_.at()[h] - x_[i]) / step_;
    const Vec3 free = (v_plus_[i] - v_minus_[i]) / step_;
    if (n_ == 0) v_minus_[i] = velocity;
    anchor_force_[h] = model_->mass[i] * ((velocity - v_minus_[i]) / step_ - free);
    if (n_ > 0) anchor_half_work_ += 0.5 * step_ * anchor_force_[h].dot(v_minus_[i]);
    v_plus_[i] = velocity;
    x_next_[i] = held_.at()[h];
    v_next_[i] = velocity;
  }
}

void Leapfrog::book_anchors() {
  const std::vector<Vec3>& absorbed = correction_.solver().nodes().absorbed();
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const std::uint32_t i = held_.node(h);
    const Vec3 moved = n_ > 0 ? Vec3(v_minus_[i] + v_plus_[i]) : v_plus_[i];
    anchor_forces_.add(held_, h, step_ * anchor_force_[h] - absorbed[h],
                       0.5 * step_ * anchor_force_[h].dot(moved) - absorbed[h].dot(v_plus_[i]));
  }
  correction_.solver().springs().book(anchor_forces_);
  anchor_energy_ = correction_.solver().springs().energy();
}

void Leapfrog::commit() {
  book_anchors();
  if (with_ledger_) {
    book_damping(v_plus_);
    if (books_scheme_) losses_.lost_scheme -= half_spring_work();
    book_correction();
    if (volumes_)
      booked_corners_ = corner_energy(*model_, correction_.solver().resisting(), x_next_);
  }
  if (integrator_ == Integrator::velocity_verlet)
    for (std::size_t i = 0; i < x_.size(); ++i)
      v_damping_[i] = v_next_[i] + 0.5 * (v_plus_[i] - v_minus_[i]);
  std::swap(x_, x_next_);
  std::swap(v_minus_, v_next_);
  contacts_ = correction_.solver().now();
  ++n_;
  const StepCorrection& solver = correction_.solver();
  note_inversions(solver.inverted(), solver.late_inverted());
}

void Leapfrog::book_damping(const std::vector<Vec3>& v) {
  double damping = 0;
  for (std::size_t i = 0; i < x_.size(); ++i) damping -= damping_force_[i].dot(v[i]);
  losses_.lost_damping += 0.5 * step_ * damping;
}

// Half of the trapezoid rule for the work of the springs over a step, with the forces at x_n.
double Leapfrog::half_spring_work() const {
  double power = 0;
  for (std::size_t i = 0; i < x_.size(); ++i)
    power += (force_[i] - damping_force_[i]).dot(v_step_[i]);
  return 0.5 * step_ * power;
}

// See LedgerEntry. The damping forces take their own part.
double Leapfrog::half_work(std::uint32_t node, const Vec3& displacement) const {
  const Vec3 force = force_[node] - damping_force_[node] + model_->mass[node] * gravity_;
  return 0.5 * force.dot(displacement);
}

void Leapfrog::book_end() {
  for (const NodeChange& change : correction_.solver().changes()) {
    losses_.lost_contact -= half_work(change.node, change.by_contacts(step_));
    losses_.lost_corners -= half_work(change.node, change.by_corners);
    losses_.lost_anchors -= half_work(change.node, change.by_spring);
  }
}

void Leapfrog::book_correction() {
  const StepCorrection& solver = correction_.solver();
  losses_.lost_contact += solver.losses().contact;
  losses_.lost_friction += solver.losses().friction;
  losses_.lost_corners += solver.losses().corners;
  losses_.lost_anchors += solver.losses().anchors;
  for (const NodeChange& change : solver.changes()) {
    losses_.lost_contact += half_work(change.node, change.by_contacts(step_));
    losses_.lost_corners += half_work(change.node, change.by_corners);
    losses_.lost_anchors += half_work(change.node, change.by_spring);
    losses_.lost_friction += half_work(change.node, change.by_friction(step_));
  }
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
  const double corners = volumes_ ? corner_energy(*model_, x_) : 0;
  entry.elastic = elastic_energy(*model_, x_) + corners;
  entry.lost_corners -= corners - booked_corners_;
  entry.gravity = gravity_energy();
  entry.anchors = anchor_energy_;
  entry.contact = contact_energy(contacts_);
  entry.anchor_work = anchor_work();
  return entry;
}

}  // namespace springlod::sim
