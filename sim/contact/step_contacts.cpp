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

}  // namespace

void StepContacts::begin(double step) {
  step_ = step;
  inverse_step_ = 1 / step;
  std::swap(contacts_, before_);
  contacts_.clear();
  touches_.clear();
  shares_.clear();
  losses_ = {};
}

void StepContacts::check(const Contact& before, StepNodes& nodes) {
  const std::size_t first = shares_.size();
  add_shares(before.point, nodes);
  StepPath path;
  for (std::size_t s = first; s < shares_.size(); ++s) {
    const StepPath& of_node = nodes.path(shares_[s].slot);
    path.from += shares_[s].weight * of_node.from;
    path.to += shares_[s].weight * of_node.to;
  }
  const auto end = finder_->penetration(before.obstacle, before.point, path.to);
  Contact contact = finder_->contact(before.obstacle, before.point,
                                     end ? end->normal : before.normal, frame(before.point, nodes));
  contact.continue_from(before);
  touches_.push_back(touch(contact, &before, path, end));
  start_from(before, touches_.back(), nodes);
}

void StepContacts::check(std::uint32_t obstacle, std::uint32_t point, const StepPath& path,
                         StepNodes& nodes) {
  const auto end = finder_->penetration(obstacle, point, path.to);
  if (!end) return;
  add_shares(point, nodes);
  touches_.push_back(touch(finder_->contact(obstacle, point, end->normal, frame(point, nodes)),
                           nullptr, path, end));
}

void StepContacts::add_shares(std::uint32_t point, StepNodes& nodes) {
  for (const ContactPoints::Share& share : points_->shares(point))
    shares_.push_back({nodes.slot(share.node), share.weight, share.kick});
}

// The nodes of the point were added last.
Mat3 StepContacts::frame(std::uint32_t point, const StepNodes& nodes) const {
  auto share = shares_.end() - static_cast<std::ptrdiff_t>(points_->shares(point).size());
  return points_->frame(
      point, [&](std::uint32_t) -> const Vec3& { return nodes.path((share++)->slot).from; });
}

StepContacts::Touch StepContacts::touch(const Contact& contact, const Contact* was,
                                        const StepPath& path,
                                        const std::optional<Penetration>& end) {
  const double mass = points_->mass(contact.point);
  const auto shares = static_cast<std::uint32_t>(points_->shares(contact.point).size());
  const auto last = static_cast<std::uint32_t>(shares_.size());
  Touch touch{.contact = contact,
              .law = NormalLaw({.stiffness = contact.stiffness,
                                .damping = contact.damping * inverse_step_,
                                .mobility = step_ * step_ / (2 * mass)}),
              .friction = FrictionLaw(contact, mass, step_),
              .mass = mass,
              .path = path,
              .first = last - shares,
              .end = last};
  // The depth of a contact that continues is known; geometry would give it with other rounding.
  const bool same_face = was != nullptr && was->normal == contact.normal;
  if (end) {
    touch.level = end->depth + contact.normal.dot(path.to);
    touch.before = same_face ? was->depth : touch.level - contact.normal.dot(path.from);
  } else {
    touch.before = was->depth;
    touch.level = was->depth + contact.normal.dot(path.from);
  }
  // A point on another face of a box than before, that other contacts pushed in, or where the
  // surface has turned.
  losses_.contact += (was != nullptr ? was->energy() : 0) -
                     penalty_energy(contact.stiffness, touch.before) - contact.stick_energy();
  return touch;
}

// The forces of the last step need fewer sweeps than none.
void StepContacts::start_from(const Contact& was, Touch& touch, StepNodes& nodes) const {
  Contact& contact = touch.contact;
  contact.normal_force = was.normal_force;
  contact.slip_change = was.slip_change;
  push(touch, touch.law.mobility() * was.normal_force * contact.normal + step_ * was.slip_change,
       nodes);
}

void StepContacts::push(const Touch& touch, const Vec3& change, StepNodes& nodes) const {
  for (std::uint32_t s = touch.first; s < touch.end; ++s)
    nodes.move(shares_[s].slot, shares_[s].kick * change);
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
    largest = std::max(largest, touch.law.mobility() * touch.contact.normal_force);
  }
  return largest > 0 ? largest_change / largest : 0;
}

Vec3 StepContacts::position(const Touch& touch, const StepNodes& nodes) const {
  Vec3 sum = Vec3::Zero();
  for (std::uint32_t s = touch.first; s < touch.end; ++s)
    sum += shares_[s].weight * nodes.at(shares_[s].slot);
  return sum;
}

// The kicks of a point's nodes move the point by the displacement itself, so its position need not
// be computed again between normal force and friction.
double StepContacts::update(Touch& touch, StepNodes& nodes) {
  Contact& contact = touch.contact;
  Vec3 at = position(touch, nodes);
  const double free =
      touch.level - contact.normal.dot(at) + touch.law.mobility() * contact.normal_force;
  const double force = touch.law.solve(touch.before, free).force;
  const Vec3 pushed = touch.law.mobility() * (force - contact.normal_force) * contact.normal;
  contact.normal_force = force;
  at += pushed;
  const Vec3 slid = contact.friction > 0 ? update_friction(touch, at) : Vec3::Zero();
  const Vec3 change = pushed + slid;
  if (change.isZero(0)) return 0;
  push(touch, change, nodes);
  return change.norm();
}

Vec3 StepContacts::update_friction(Touch& touch, const Vec3& at) const {
  Contact& contact = touch.contact;
  const Vec3 slip_before = contact.slip_change;
  if (contact.normal_force == 0 && slip_before.isZero(0)) return Vec3::Zero();
  contact.slip_change =
      touch.friction.slip_change(inverse_step_ * (at - touch.path.from) - slip_before,
                                 contact.friction * contact.normal_force * step_);
  return step_ * (contact.slip_change - slip_before);
}

void StepContacts::finish(StepNodes& nodes) {
  for (Touch& touch : touches_) {
    if (touch.contact.friction > 0) touch.friction.finish(touch.contact);
    for (std::uint32_t s = touch.first; s < touch.end; ++s)
      nodes.add_slide(shares_[s].slot, shares_[s].kick * step_ * touch.contact.slip_change);
  }
  for (Touch& touch : touches_) {
    touch.contact.depth = touch.level - touch.contact.normal.dot(position(touch, nodes));
    book(touch, nodes);
    if (touch.contact.depth > 0) contacts_.push_back(touch.contact);
  }
}

void StepContacts::book(const Touch& touch, const StepNodes& nodes) {
  const Contact& contact = touch.contact;
  losses_.contact += contact.normal_force * (contact.depth - touch.before) -
                     penalty_energy(contact.stiffness, contact.depth) +
                     penalty_energy(contact.stiffness, touch.before);
  Vec3 slide = Vec3::Zero();  // of the point, by the friction of all contacts [m]
  for (std::uint32_t s = touch.first; s < touch.end; ++s)
    slide += shares_[s].weight * nodes.slide(shares_[s].slot);
  const Vec3 free = touch.path.to - touch.path.from;
  losses_.friction -=
      touch.mass / step_ * contact.slip_change.dot(free + 0.5 * slide) + contact.stick_gain;
  if (contact.depth <= 0) losses_.friction += contact.stick_energy();
}

}  // namespace springlod::sim
