#include "sim/integrators/whole_step.hpp"

#include <utility>

#include "sim/contact/step_correction.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {

WholeStep::WholeStep(const MassSpringModel& model, const Scenario& scenario, const State& start,
                     double step, const StepperOptions& options)
    : StepByStep(model, scenario, start, step, options.skin.get()),
      with_ledger_(options.ledger),
      v_(start.v),
      x_next_(start.x),
      v_next_(start.v),
      implicit_(is_implicit(options.integrator)),
      touching_(points_, finder_, model.node_count()) {
  finder_.find(x_, v_, contacts_);
  touching_.set(contacts_);
}

void WholeStep::prepare() {
  solve();
  next_losses_.lost_damping = lost_damping_;
  if (implicit_)
    find_contacts();
  else
    correct_contacts();
}

void WholeStep::correct_contacts() {
  const std::vector<Vec3> free_x = x_next_;
  const std::vector<Vec3> free_v = v_next_;
  correct_step(points_, obstacle_count_, step_, x_, touching_, x_next_, v_next_);
  next_contacts_ = touching_.now();
  next_losses_.lost_contact += touching_.losses().contact;
  next_losses_.lost_friction += touching_.losses().friction;
  if (with_ledger_ && !touching_.changes().empty())
    next_losses_.lost_contact -= gain_by_shift(free_x, free_v);
}

// The contacts work over the displacement of the step, but they change the velocities at its end,
// and the potential energy of the other forces.
double WholeStep::gain_by_shift(const std::vector<Vec3>& free_x, const std::vector<Vec3>& free_v) {
  double gain = elastic_energy(*model_, x_next_) - elastic_energy(*model_, free_x);
  for (const NodeChange& change : touching_.changes()) {
    const std::uint32_t i = change.node;
    const Vec3 ahead = free_v[i] - (free_x[i] - x_[i]) / step_;
    gain += model_->mass[i] * (change.kick.dot(ahead) - gravity_.dot(change.displacement));
  }
  return gain;
}

void WholeStep::find_contacts() {
  finder_.find(x_next_, v_next_, next_contacts_);
  keep_stick_springs(contacts_, next_contacts_);
  add_friction();
  for (const Contact& c : next_contacts_)
    next_losses_.lost_contact -=
        step_ * c.damping_force * c.normal.dot(points_.interpolate(c.point, v_next_));
}

void WholeStep::finish_implicit(const ImplicitSprings& springs) {
  for (std::size_t i = 0; i < x_.size(); ++i) v_next_[i] = (x_next_[i] - x_[i]) / step_;
  if (with_ledger_) lost_damping_ += springs.damping_loss(x_next_);
}

void WholeStep::add_friction() {
  const auto held = [](const std::vector<Contact>& contacts) {
    double energy = 0;
    for (const Contact& c : contacts) energy += c.stick_energy();
    return energy;
  };
  next_losses_.lost_friction += apply_friction(points_, step_, next_contacts_, v_next_);
  next_losses_.lost_friction += held(contacts_) - held(next_contacts_);
  for (const Contact& c : next_contacts_) points_.kick(c.point, step_ * c.slip_change, x_next_);
}

void WholeStep::commit() {
  std::swap(x_, x_next_);
  std::swap(v_, v_next_);
  std::swap(contacts_, next_contacts_);
  losses_ = next_losses_;
  ++n_;
}

std::vector<Vec3> WholeStep::positions_at(double time) const {
  const double part = (time - this->time()) / step_;
  std::vector<Vec3> x = x_;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += part * (x_next_[i] - x_[i]);
  return x;
}

LedgerEntry WholeStep::ledger_entry() const {
  LedgerEntry entry = losses_;
  entry.time = time();
  for (std::size_t i = 0; i < x_.size(); ++i)
    entry.kinetic += 0.5 * model_->mass[i] * v_[i].squaredNorm();
  entry.elastic = elastic_energy(*model_, x_);
  entry.gravity = gravity_energy();
  entry.contact = contact_energy(contacts_);
  return entry;
}

}  // namespace springlod::sim
