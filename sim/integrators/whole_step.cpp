#include "sim/integrators/whole_step.hpp"

#include <algorithm>
#include <utility>

#include "sim/correction/corner_law.hpp"
#include "sim/integrators/kernel.hpp"

namespace springlod::sim {

WholeStep::WholeStep(const MassSpringModel& model, const Scenario& scenario, const State& start,
                     double step, const StepperOptions& options)
    : StepByStep(model, scenario, start, step, options.skin.get(), options.anchors),
      with_ledger_(options.ledger),
      v_(start.v),
      x_next_(start.x),
      v_next_(start.v),
      anchor_steps_(held_.count()),
      implicit_anchors_(anchor_springs_, step),
      implicit_(is_implicit(options.integrator)),
      volumes_(options.volumes && !implicit_),
      correction_(model, points_, finder_, obstacle_count_, options.volumes,
                  {.held = &held_, .springs = &anchor_springs_}),
      booked_corners_(volumes_ ? corner_energy(model, start.x) : 0) {
  finder_.find(x_, v_, x_, contacts_);
  correction_.solver().set(contacts_);
}

void WholeStep::prepare() {
  solve();
  const double damping = lost_damping_ - next_losses_.lost_damping;
  next_losses_.lost_damping = lost_damping_;
  if (implicit_) return find_contacts();
  if (with_ledger_) {
    next_losses_.lost_scheme += lost_energy() - damping;
    for (const AnchorStep& anchor : anchor_steps_) next_losses_.lost_scheme += anchor.work;
  }
  correct();
}

double WholeStep::lost_energy() const {
  double lost = elastic_energy(*model_, x_) - elastic_energy(*model_, x_next_);
  for (std::size_t i = 0; i < x_.size(); ++i)
    lost += model_->mass[i] * (0.5 * (v_[i].squaredNorm() - v_next_[i].squaredNorm()) +
                               gravity_.dot(x_next_[i] - x_[i]));
  return lost;
}

void WholeStep::correct() {
  const std::vector<Vec3> free_x = x_next_;
  const std::vector<Vec3> free_v = v_next_;
  correction_.correct(step_, x_, x_next_, v_next_);
  const StepCorrection& solver = correction_.solver();
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const Vec3& absorbed = solver.nodes().absorbed()[h];
    anchor_steps_[h].impulse -= absorbed;
    anchor_steps_[h].work -= absorbed.dot(x_next_[held_.node(h)] - x_[held_.node(h)]) / step_;
  }
  next_contacts_ = solver.now();
  next_losses_.lost_contact += solver.losses().contact;
  next_losses_.lost_friction += solver.losses().friction;
  next_losses_.lost_corners += solver.losses().corners;
  next_losses_.lost_anchors += solver.losses().anchors;
  if (with_ledger_ && !solver.changes().empty()) book_gains(free_x, free_v);
}

void WholeStep::book_gains(const std::vector<Vec3>& free_x, const std::vector<Vec3>& free_v) {
  const std::vector<NodeChange>& changes = correction_.solver().changes();
  const bool by_corners = std::any_of(changes.begin(), changes.end(), [](const NodeChange& change) {
    return !change.by_corners.isZero(0);
  });
  double booked = gain_by_shift(free_x, free_v, {});
  next_losses_.lost_contact -= booked;
  if (by_corners) {
    const double gain = gain_by_shift(free_x, free_v, {.corners = true});
    next_losses_.lost_corners -= gain - booked;
    booked = gain;
  }
  if (!anchor_springs_.empty())
    next_losses_.lost_anchors -=
        gain_by_shift(free_x, free_v, {.corners = true, .springs = true}) - booked;
}

// Contacts, corners and springs of anchors work over the displacement of the step, but they change
// the velocities at its end, and the potential energy of the other forces.
double WholeStep::gain_by_shift(const std::vector<Vec3>& free_x, const std::vector<Vec3>& free_v,
                                const Parts& parts) const {
  std::vector<Vec3> x = x_next_;
  double gain = 0;
  for (const NodeChange& change : correction_.solver().changes()) {
    const std::uint32_t i = change.node;
    Vec3 left_out = Vec3::Zero();
    if (!parts.corners) left_out += change.by_corners;
    if (!parts.springs) left_out += change.by_spring;
    x[i] -= left_out;
    const Vec3 kick = change.kick - 2 / step_ * left_out;
    const Vec3 ahead = free_v[i] - (free_x[i] - x_[i]) / step_;
    gain += model_->mass[i] * (kick.dot(ahead) - gravity_.dot(change.displacement - left_out));
  }
  return gain + elastic_energy(*model_, x) - elastic_energy(*model_, free_x);
}

void WholeStep::find_contacts() {
  finder_.find(x_next_, v_next_, x_, next_contacts_);
  keep_stick_springs(contacts_, next_contacts_);
  add_friction();
  absorb_contacts();
  for (const Contact& c : next_contacts_)
    next_losses_.lost_contact -=
        step_ * c.damping_force * c.normal.dot(points_.interpolate(c.point, v_next_));
}

void WholeStep::hold_nodes() {
  move_anchors(n_ + 1);
  held_.put(x_next_);
  if (implicit_) implicit_anchors_.begin_step(x_);
}

void WholeStep::find_anchor_forces(const ImplicitSprings& springs) {
  if (held_.empty()) return;
  std::vector<Vec3> force(x_.size(), Vec3::Zero());  // of the springs on held nodes [N]
  for (std::uint32_t s = 0; s < model_->spring_count(); ++s) {
    const std::uint32_t a = model_->a[s];
    const std::uint32_t b = model_->b[s];
    if (!held_.holds(a) && !held_.holds(b)) continue;
    const auto [unit, length] = spring_axis(*model_, s, x_next_);
    const Vec3 pull = springs.stiffness(s) * (length - springs.rest_length(s)) * unit;
    force[a] += pull;
    force[b] -= pull;
  }
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const std::uint32_t i = held_.node(h);
    const Vec3 impulse =
        model_->mass[i] * (v_next_[i] - v_[i] - step_ * gravity_) - step_ * force[i];
    anchor_steps_[h] = {impulse, impulse.dot(v_next_[i])};
  }
}

void WholeStep::absorb_contacts() {
  if (held_.empty()) return;
  std::vector<Vec3> absorbed(x_.size(), Vec3::Zero());  // [N s]
  for (const Contact& c : next_contacts_)
    points_.add_force(c.point,
                      step_ * c.normal_force * c.normal + points_.mass(c.point) * c.slip_change,
                      absorbed);
  for (std::uint32_t h = 0; h < held_.count(); ++h) {
    const Vec3& impulse = absorbed[held_.node(h)];
    anchor_steps_[h].impulse -= impulse;
    anchor_steps_[h].work -= impulse.dot(v_next_[held_.node(h)]);
  }
}

void WholeStep::finish_implicit(const ImplicitSprings& springs) {
  for (std::size_t i = 0; i < x_.size(); ++i) v_next_[i] = (x_next_[i] - x_[i]) / step_;
  find_anchor_forces(springs);
  next_losses_.lost_anchors += implicit_anchors_.end_step(x_next_);
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

void WholeStep::book_springs() {
  if (implicit_) {
    implicit_anchors_.book(anchor_forces_);
    anchor_energy_ = implicit_anchors_.stored(x_next_);
  } else {
    correction_.solver().springs().book(anchor_forces_);
    anchor_energy_ = correction_.solver().springs().energy();
  }
}

void WholeStep::commit() {
  for (std::uint32_t h = 0; h < held_.count(); ++h)
    anchor_forces_.add(held_, h, anchor_steps_[h].impulse, anchor_steps_[h].work);
  book_springs();
  if (with_ledger_ && volumes_)
    booked_corners_ = corner_energy(*model_, correction_.solver().resisting(), x_next_);
  std::swap(x_, x_next_);
  std::swap(v_, v_next_);
  std::swap(contacts_, next_contacts_);
  losses_ = next_losses_;
  ++n_;
  if (implicit_)
    note_inversions(inverted_corners(model_->corners, x_), {});
  else
    note_inversions(correction_.solver().inverted(), correction_.solver().late_inverted());
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
