#include "sim/contact/step_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace springlod::sim {
namespace {

// The sweeps end when no contact moves its point by more than this fraction of the largest
// displacement by a contact [1]. The ledger holds the remaining error as a loss of the contacts.
constexpr double kTolerance = 1e-3;
// The sweeps converge within 10 unless many points share few nodes; they are stable if cut short.
constexpr int kMostSweeps = 100;

// Interval in which the surface of a point that stays on a face turns with the body [steps]. A body
// that rolls or vibrates turns by a few hundredths in that time, and computing how its surface
// yields takes a quarter of what a contact costs once per step.
constexpr std::uint64_t kTurnEvery = 8;

// Depth at the start of a path under the face of the penetration at its end [m].
double depth_before(const Penetration& end, const PaddedPath& path) {
  return end.depth + dot(padded(end.normal), path.to - path.from);
}

}  // namespace

// Sums of their own: what is stored in a result might change the shares, for all the compiler
// knows.
inline PaddedPath StepContacts::path(const Touch& touch, const StepNodes& nodes) const {
  const std::span<const PaddedPath> paths = nodes.paths();
  Padded from = Padded::Zero();
  Padded to = Padded::Zero();
  for (const Share& share : shares(touch)) {
    from += share.weight * paths[share.slot].from;
    to += share.weight * paths[share.slot].to;
  }
  return {from, to};
}

inline Padded StepContacts::position(const Touch& touch, const StepNodes& nodes) const {
  const std::span<const Padded> at = nodes.all_at();
  Padded sum = Padded::Zero();
  for (const Share& share : shares(touch)) sum += share.weight * at[share.slot];
  return sum;
}

inline void StepContacts::push(const Touch& touch, const Padded& change, StepNodes& nodes) const {
  const std::span<Padded> at = nodes.all_at();
  for (const Share& share : shares(touch)) at[share.slot] += share.kick * change;
}

void StepContacts::set(std::vector<Contact> contacts) {
  contacts_ = std::move(contacts);
  touches_.assign(contacts_.size(), {});
  for (std::size_t t = 0; t < touches_.size(); ++t)
    touches_[t].normal_force = contacts_[t].normal_force;
  new_shares_ = true;
  step_ = 0;  // the laws are not set
}

void StepContacts::begin(double step, const StepPaths& paths, StepNodes& nodes) {
  ++number_;
  checked_ = 0;
  losses_ = {};
  if (new_shares_) nodes.keep_none();
  nodes.begin(paths);
  if (new_shares_) {
    shares_.clear();
    for (std::size_t t = 0; t < touches_.size(); ++t)
      gather_shares(contacts_[t].point, touches_[t], nodes);
    new_shares_ = false;
  }
  if (step == step_) return;
  step_ = step;
  inverse_step_ = 1 / step;
  for (std::size_t t = 0; t < touches_.size(); ++t) set_laws(contacts_[t], touches_[t]);
}

void StepContacts::continue_next(StepNodes& nodes) {
  Contact& contact = contacts_[checked_];
  Touch& touch = touches_[checked_];
  touch.path = path(touch, nodes);
  const auto end = finder_->penetration(contact.obstacle, contact.point, touch.path.to.head<3>());
  // The depth of a contact that continues is known; geometry would give it with other rounding.
  touch.before = contact.depth;
  touch.level = contact.depth + dot(touch.normal, touch.path.from);
  if (!end && touch.level - dot(touch.normal, touch.path.to) > 0) {
    end_next();
    return;
  }
  ++checked_;
  losses_.contact += contact.energy();
  const bool same_face = !end || end->normal == contact.normal;
  if (end && same_face) touch.level = end->depth + dot(touch.normal, touch.path.to);
  // A point that is deeper under the new face than under its own takes it in the next step: what a
  // face presses it out must not be more than what it was pressed in.
  const bool takes_face = !same_face && depth_before(*end, touch.path) <= contact.depth;
  // By turns, so that all steps cost the same.
  const bool turns = points_->turns(contact.point) && (number_ + contact.point) % kTurnEvery == 0;
  if (turns || takes_face) {
    contact = turned(contact, takes_face ? end->normal : contact.normal, touch, nodes);
    set_laws(contact, touch);
  }
  if (takes_face) {
    touch.before = depth_before(*end, touch.path);
    touch.level = end->depth + dot(touch.normal, touch.path.to);
  }
  contact.continue_from(contact);
  touch.slider.start(contact);
  // Differs from the energy before on another face, or where the surface has turned.
  losses_.contact -= penalty_energy(contact.stiffness, touch.before) + contact.stick_energy();
  // The forces of the last step need fewer sweeps than none.
  push(touch, touch.law.mobility() * touch.normal_force * touch.normal + step_ * touch.slip_change,
       nodes);
}

void StepContacts::end_next() {
  const Contact& contact = contacts_[checked_];
  losses_.contact += penalty_energy(contact.stiffness, contact.depth);
  losses_.friction += contact.stick_energy();
  const auto at = static_cast<std::ptrdiff_t>(checked_);
  contacts_.erase(contacts_.begin() + at);
  touches_.erase(touches_.begin() + at);
  new_shares_ = true;
}

void StepContacts::check(std::uint32_t obstacle, std::uint32_t point, const StepPath& path,
                         StepNodes& nodes) {
  const auto end = finder_->entry(obstacle, point, path);
  if (!end) return;
  Touch touch;
  gather_shares(point, touch, nodes);
  touch.path = {padded(path.from), padded(path.to)};
  const Contact contact =
      finder_->contact(obstacle, point, end->normal, frame(point, touch, nodes));
  set_laws(contact, touch);
  touch.level = end->depth + dot(touch.normal, touch.path.to);
  touch.before = touch.level - dot(touch.normal, touch.path.from);
  // Where other contacts pushed it in.
  losses_.contact -= penalty_energy(contact.stiffness, touch.before);
  const auto at = static_cast<std::ptrdiff_t>(checked_);
  contacts_.insert(contacts_.begin() + at, contact);
  touches_.insert(touches_.begin() + at, touch);
  ++checked_;
}

Contact StepContacts::turned(const Contact& before, const Vec3& normal, const Touch& touch,
                             const StepNodes& nodes) const {
  Contact now =
      finder_->contact(before.obstacle, before.point, normal, frame(before.point, touch, nodes));
  now.depth = before.depth;
  now.normal_force = before.normal_force;
  now.stretch = before.stretch;
  now.yield = before.yield;
  return now;
}

void StepContacts::gather_shares(std::uint32_t point, Touch& touch, StepNodes& nodes) {
  touch.first = static_cast<std::uint32_t>(shares_.size());
  for (const ContactPoints::Share& share : points_->shares(point))
    shares_.push_back({nodes.slot(share.node), share.weight, share.kick});
  touch.end = static_cast<std::uint32_t>(shares_.size());
}

void StepContacts::set_laws(const Contact& contact, Touch& touch) const {
  touch.normal = padded(contact.normal);
  touch.friction = contact.friction;
  touch.mass = points_->mass(contact.point);
  touch.law = NormalLaw({.stiffness = contact.stiffness,
                         .damping = contact.damping * inverse_step_,
                         .mobility = step_ * step_ / (2 * touch.mass)});
  touch.slider = FrictionLaw(contact, touch.mass, step_);
}

Mat3 StepContacts::frame(std::uint32_t point, const Touch& touch, const StepNodes& nodes) const {
  const Share* share = shares_.data() + touch.first;
  return points_->frame(point,
                        [&](std::uint32_t) -> Vec3 { return nodes.path((share++)->slot).from; });
}

void StepContacts::solve(StepNodes& nodes) {
  for (int i = 0; i < kMostSweeps; ++i)
    if (sweep(nodes) < kTolerance || !nodes.shared()) return;
}

double StepContacts::sweep(StepNodes& nodes) {
  double largest_change = 0;
  double largest = 0;
  for (Touch& touch : touches_) {
    largest_change = std::max(largest_change, update(touch, nodes));
    largest = std::max(largest, touch.law.mobility() * touch.normal_force);
  }
  return largest > 0 ? largest_change / largest : 0;
}

// The kicks of a point's nodes move the point by the displacement itself, so its position need not
// be computed again between normal force and friction.
double StepContacts::update(Touch& touch, StepNodes& nodes) const {
  Padded at = position(touch, nodes);
  const double free =
      touch.level - dot(touch.normal, at) + touch.law.mobility() * touch.normal_force;
  const double force = touch.law.solve(touch.before, free).force;
  Padded change = touch.law.mobility() * (force - touch.normal_force) * touch.normal;
  touch.normal_force = force;
  if (touch.friction > 0) {
    at += change;
    change += update_friction(touch, at);
  }
  if (change.isZero(0)) return 0;
  push(touch, change, nodes);
  return std::sqrt(dot(change, change));
}

Padded StepContacts::update_friction(Touch& touch, const Padded& at) const {
  const Padded slip_before = touch.slip_change;
  if (touch.normal_force == 0 && slip_before.isZero(0)) return Padded::Zero();
  touch.slip_change = touch.slider.slip_change(inverse_step_ * (at - touch.path.from) - slip_before,
                                               touch.friction * touch.normal_force * step_);
  return step_ * (touch.slip_change - slip_before);
}

void StepContacts::finish(StepNodes& nodes) {
  const std::span<Padded> slides = nodes.slides();
  for (const Touch& touch : touches_) {
    if (nodes.held_count() > 0) absorb(touch, nodes);
    if (touch.friction == 0) continue;
    const Padded slide = step_ * touch.slip_change;
    for (const Share& share : shares(touch)) slides[share.slot] += share.kick * slide;
  }
  book_slides(nodes);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < touches_.size(); ++t) {
    const Touch& touch = touches_[t];
    Contact& contact = contacts_[t];
    contact.depth = touch.level - dot(touch.normal, position(touch, nodes));
    contact.normal_force = touch.normal_force;
    contact.slip_change = touch.slip_change.head<3>();
    if (touch.friction > 0) touch.slider.finish(contact);
    book(touch, contact);
    if (!(contact.depth > 0)) continue;
    if (kept != t) {
      contacts_[kept] = contact;
      touches_[kept] = touch;
    }
    ++kept;
  }
  new_shares_ = new_shares_ || kept != contacts_.size();
  contacts_.resize(kept);
  touches_.resize(kept);
}

void StepContacts::absorb(const Touch& touch, StepNodes& nodes) const {
  const Padded impulse = step_ * touch.normal_force * touch.normal + touch.mass * touch.slip_change;
  for (const Share& share : shares(touch))
    if (nodes.is_held(share.slot)) nodes.absorb(share.slot, (share.weight * impulse).head<3>());
}

void StepContacts::book(const Touch& touch, const Contact& contact) {
  losses_.contact += contact.normal_force * (contact.depth - touch.before) -
                     penalty_energy(contact.stiffness, contact.depth) +
                     penalty_energy(contact.stiffness, touch.before);
  const Padded free = touch.path.to - touch.path.from;
  losses_.friction -=
      touch.mass * inverse_step_ * dot(touch.slip_change, free) + contact.stick_gain;
  if (contact.depth <= 0) losses_.friction += contact.stick_energy();
}

// The impulses J_p of friction do the work sum J_p . slide_p / (2 dt) on the slides of their
// points, which is a sum over the nodes: slide_p = sum w_pi slide_i, m_i slide_i / dt = sum w_pi
// J_p.
void StepContacts::book_slides(const StepNodes& nodes) {
  const std::span<const Padded> slides = nodes.slides();
  for (std::uint32_t slot = 0; slot < nodes.count(); ++slot)
    losses_.friction -= 0.5 * points_->node_mass(nodes.node(slot)) * inverse_step_ * inverse_step_ *
                        dot(slides[slot], slides[slot]);
}

}  // namespace springlod::sim
