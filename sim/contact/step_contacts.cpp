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

}  // namespace

void StepContacts::begin(double step) {
  ++number_;
  step_ = step;
  inverse_step_ = 1 / step;
  std::swap(contacts_, before_);
  contacts_.clear();
  touches_.clear();
  shares_.clear();
  losses_ = {};
}

void StepContacts::check(const Contact& before, StepNodes& nodes) {
  Touch& touch = add_touch(before.point, nodes);
  touch.path = path(touch, nodes);
  const auto end = finder_->penetration(before.obstacle, before.point, touch.path.to);
  const Vec3& normal = end ? end->normal : before.normal;
  Contact& contact = contacts_.emplace_back(before);
  // By turns, so that all steps cost the same.
  const bool turns = points_->turns(before.point) && (number_ + before.point) % kTurnEvery == 0;
  if (turns || normal != before.normal) {
    contact =
        finder_->contact(before.obstacle, before.point, normal, frame(before.point, touch, nodes));
    // The forces of the last step need fewer sweeps than none.
    contact.normal_force = before.normal_force;
    contact.slip_change = before.slip_change;
  }
  contact.continue_from(before);
  set_up(contact, &before, end, touch);
  push(touch,
       touch.law.mobility() * contact.normal_force * contact.normal + step_ * contact.slip_change,
       nodes);
}

void StepContacts::check(std::uint32_t obstacle, std::uint32_t point, const StepPath& path,
                         StepNodes& nodes) {
  const auto end = finder_->penetration(obstacle, point, path.to);
  if (!end) return;
  Touch& touch = add_touch(point, nodes);
  touch.path = path;
  contacts_.push_back(finder_->contact(obstacle, point, end->normal, frame(point, touch, nodes)));
  set_up(contacts_.back(), nullptr, end, touch);
}

StepContacts::Touch& StepContacts::add_touch(std::uint32_t point, StepNodes& nodes) {
  Touch& touch = touches_.emplace_back(static_cast<std::uint32_t>(shares_.size()));
  for (const ContactPoints::Share& share : points_->shares(point))
    shares_.push_back({nodes.slot(share.node), share.weight, share.kick});
  touch.end = static_cast<std::uint32_t>(shares_.size());
  return touch;
}

Mat3 StepContacts::frame(std::uint32_t point, const Touch& touch, const StepNodes& nodes) const {
  const Share* share = shares_.data() + touch.first;
  return points_->frame(point,
                        [&](std::uint32_t) -> Vec3 { return nodes.path((share++)->slot).from; });
}

StepPath StepContacts::path(const Touch& touch, const StepNodes& nodes) const {
  PaddedPath sum;
  for (std::uint32_t s = touch.first; s < touch.end; ++s) {
    const PaddedPath& of_node = nodes.padded_path(shares_[s].slot);
    sum.from += shares_[s].weight * of_node.from;
    sum.to += shares_[s].weight * of_node.to;
  }
  return sum.path();
}

void StepContacts::set_up(const Contact& contact, const Contact* was,
                          const std::optional<Penetration>& end, Touch& touch) {
  touch.mass = points_->mass(contact.point);
  touch.law = NormalLaw({.stiffness = contact.stiffness,
                         .damping = contact.damping * inverse_step_,
                         .mobility = step_ * step_ / (2 * touch.mass)});
  touch.friction = FrictionLaw(contact, touch.mass, step_);
  // The depth of a contact that continues is known; geometry would give it with other rounding.
  const bool same_face = was != nullptr && was->normal == contact.normal;
  if (end) {
    touch.level = end->depth + contact.normal.dot(touch.path.to);
    touch.before = same_face ? was->depth : touch.level - contact.normal.dot(touch.path.from);
  } else {
    touch.before = was->depth;
    touch.level = was->depth + contact.normal.dot(touch.path.from);
  }
  // A point on another face of a box than before, that other contacts pushed in, or where the
  // surface has turned.
  losses_.contact += (was != nullptr ? was->energy() : 0) -
                     penalty_energy(contact.stiffness, touch.before) - contact.stick_energy();
}

void StepContacts::push(const Touch& touch, const Vec3& change, StepNodes& nodes) const {
  const Padded whole = padded(change);
  for (std::uint32_t s = touch.first; s < touch.end; ++s)
    nodes.move_padded(shares_[s].slot, shares_[s].kick * whole);
}

void StepContacts::solve(StepNodes& nodes) {
  for (int i = 0; i < kMostSweeps; ++i)
    if (sweep(nodes) < kTolerance || !nodes.shared()) return;
}

double StepContacts::sweep(StepNodes& nodes) {
  double largest_change = 0;
  double largest = 0;
  for (std::size_t t = 0; t < touches_.size(); ++t) {
    const Touch& touch = touches_[t];
    Contact& contact = contacts_[t];
    largest_change = std::max(largest_change, update(touch, contact, nodes));
    largest = std::max(largest, touch.law.mobility() * contact.normal_force);
  }
  return largest > 0 ? largest_change / largest : 0;
}

Vec3 StepContacts::position(const Touch& touch, const StepNodes& nodes) const {
  Padded sum = Padded::Zero();
  for (std::uint32_t s = touch.first; s < touch.end; ++s)
    sum += shares_[s].weight * nodes.padded_at(shares_[s].slot);
  return sum.head<3>();
}

// The kicks of a point's nodes move the point by the displacement itself, so its position need not
// be computed again between normal force and friction.
double StepContacts::update(const Touch& touch, Contact& contact, StepNodes& nodes) const {
  Vec3 at = position(touch, nodes);
  const double free =
      touch.level - contact.normal.dot(at) + touch.law.mobility() * contact.normal_force;
  const double force = touch.law.solve(touch.before, free).force;
  const Vec3 pushed = touch.law.mobility() * (force - contact.normal_force) * contact.normal;
  contact.normal_force = force;
  at += pushed;
  const Vec3 slid = contact.friction > 0 ? update_friction(touch, at, contact) : Vec3::Zero();
  const Vec3 change = pushed + slid;
  if (change.isZero(0)) return 0;
  push(touch, change, nodes);
  return change.norm();
}

Vec3 StepContacts::update_friction(const Touch& touch, const Vec3& at, Contact& contact) const {
  const Vec3 slip_before = contact.slip_change;
  if (contact.normal_force == 0 && slip_before.isZero(0)) return Vec3::Zero();
  contact.slip_change =
      touch.friction.slip_change(inverse_step_ * (at - touch.path.from) - slip_before,
                                 contact.friction * contact.normal_force * step_);
  return step_ * (contact.slip_change - slip_before);
}

void StepContacts::finish(StepNodes& nodes) {
  for (std::size_t t = 0; t < touches_.size(); ++t) {
    const Touch& touch = touches_[t];
    if (contacts_[t].friction == 0) continue;
    touch.friction.finish(contacts_[t]);
    const Padded slide = step_ * padded(contacts_[t].slip_change);
    for (std::uint32_t s = touch.first; s < touch.end; ++s)
      nodes.add_slide(shares_[s].slot, shares_[s].kick * slide);
  }
  book_slides(nodes);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < touches_.size(); ++t) {
    Contact& contact = contacts_[t];
    contact.depth = touches_[t].level - contact.normal.dot(position(touches_[t], nodes));
    book(touches_[t], contact);
    if (!(contact.depth > 0)) continue;
    if (kept != t) contacts_[kept] = contact;
    ++kept;
  }
  contacts_.resize(kept);
}

void StepContacts::book(const Touch& touch, const Contact& contact) {
  losses_.contact += contact.normal_force * (contact.depth - touch.before) -
                     penalty_energy(contact.stiffness, contact.depth) +
                     penalty_energy(contact.stiffness, touch.before);
  const Vec3 free = touch.path.to - touch.path.from;
  losses_.friction -=
      touch.mass * inverse_step_ * contact.slip_change.dot(free) + contact.stick_gain;
  if (contact.depth <= 0) losses_.friction += contact.stick_energy();
}

// The impulses J_p of friction do the work sum J_p . slide_p / (2 dt) on the slides of their
// points, which is a sum over the nodes: slide_p = sum w_pi slide_i, m_i slide_i / dt = sum w_pi
// J_p.
void StepContacts::book_slides(const StepNodes& nodes) {
  for (std::uint32_t slot = 0; slot < nodes.count(); ++slot)
    losses_.friction -= 0.5 * points_->node_mass(nodes.node(slot)) * inverse_step_ * inverse_step_ *
                        nodes.slide(slot).squaredNorm();
}

}  // namespace springlod::sim
