#include "sim/fast/skin_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Bounds and displacements are widened by this fraction [1], so that rounding to single precision
// leaves no point out.
constexpr double kRounding = 1e-6;

}  // namespace

SkinContacts::SkinContacts(const Shared& shared, const MassSpringModel& model)
    : FastContacts(shared),
      model_(&model),
      numbers_(points().count()),
      x_(model.rest),
      v_(model.node_count(), Vec3::Zero()),
      views_(obstacles().size()) {
  std::iota(numbers_.begin(), numbers_.end(), 0U);
  for (const std::uint32_t p : numbers_) reach_ = std::max(reach_, points().reach(p));
  for (View& view : views_) view.due.resize(points().count());
}

void SkinContacts::apply(const Step& step) {
  const Box3 here = bounds(step.frame);
  const Box3 swept = arrived_ ? here.merged(bounds_) : here;
  const bool near = near_anything(swept);
  if (near)
    for (std::uint32_t b = 0; b < body().block_count(); ++b) {
      body().get_x(b, step.frame, x_);
      body().get_v(b, step.frame, v_);
    }
  bounds_ = here;
  if (arrived_ != step.number) arrive(step, near, swept);
  // A step may be repeated with another length: the contacts of the previous step then stay the
  // same.
  if (kicked_ != step.number) contacts_before_ = std::move(contacts_);
  kicked_ = step.number;
  contacts_.clear();
  if (near)
    for (std::size_t o = 0; o < obstacles().size(); ++o) find_contacts(step, o);
  keep_stick_springs(contacts_before_, contacts_);
  add_friction(step);
  note_first(step);
  after_kick_.clear();
  for (const Contact& c : contacts_) after_kick_.push_back(kicked_velocity(c, step));
}

// The distance of a point from the centre of the nodes' box is at most its reach times half the
// size of the box.
Box3 SkinContacts::bounds(const MovingFrame& frame) const {
  Box3 nodes;
  for (std::uint32_t b = 0; b < body().block_count(); ++b) nodes.extend(body().bounds(b));
  const Vec3 half = (1 + kRounding) * reach_ / 2 * nodes.sizes();
  return moved(Box3(nodes.center() - half, nodes.center() + half), frame.origin);
}

bool SkinContacts::near_anything(const Box3& region) const {
  return std::any_of(obstacles().begin(), obstacles().end(), [&](const Obstacle& obstacle) {
    return !region_touching(obstacle, region).isEmpty();
  });
}

void SkinContacts::arrive(const Step& step, bool near, const Box3& swept) {
  const bool moved_here = arrived_.has_value();
  arrived_ = step.number;
  if (!near || !moved_here) return;
  double fastest = 0;
  for (const Vec3& v : v_) fastest = std::max(fastest, v.squaredNorm());
  travel_before_ = travel_;
  travel_ += (1 + kRounding) * step.length * std::sqrt(fastest);
  check_walls(step.number, step.length, swept, numbers_,
              [&](std::uint32_t point) { return motion(point); });
}

void SkinContacts::find_contacts(const Step& step, std::size_t obstacle) {
  const Obstacle& thing = obstacles()[obstacle];
  if (region_touching(thing, bounds_).isEmpty()) return;
  View& view = views_[obstacle];
  const bool afresh = !view.last || *view.last + 1 < step.number;
  // If the step is repeated with another length, a point that is inside by now keeps its sides.
  const bool again = view.last == step.number;
  view.last = step.number;
  for (const std::uint32_t p : numbers_) {
    if (!afresh && travel_ < view.due[p]) continue;
    const Motion now = motion(p);
    if (afresh || (!again && travel_before_ < view.due[p]))
      finder().take_sides(obstacle, p, now.x - step.length * now.v);
    view.due[p] = travel_;
    if (const Contact* contact = add_contact(obstacle, p, now)) {
      for (const ContactPoints::Share& share : points().shares(p))
        body().add_force(body().place(share.node),
                         share.weight * contact->normal_force * contact->normal);
    } else {
      view.due[p] += std::max(0.0, surface_distance(thing, now.x).distance) / points().reach(p);
    }
  }
}

void SkinContacts::add_friction(const Step& step) {
  for (Contact& c : contacts_) {
    const double mass = points().mass(c.point);
    apply_friction(c, mass, step.length, kicked_velocity(c, step));
    for (const ContactPoints::Share& share : points().shares(c.point))
      body().add_force(body().place(share.node), share.weight * mass / step.kick * c.slip_change);
  }
}

FastContacts::Motion SkinContacts::motion(std::uint32_t point) const {
  return {points().interpolate(point, x_), points().interpolate(point, v_)};
}

Vec3 SkinContacts::velocity_before_kick(std::size_t contact) const {
  return points().interpolate(contacts_[contact].point, v_);
}

Vec3 SkinContacts::kicked_velocity(const Contact& contact, const Step& step) const {
  const Vec3 fall = step.kicked.velocity - step.frame.velocity;
  Vec3 sum = Vec3::Zero();
  for (const ContactPoints::Share& share : points().shares(contact.point))
    sum += share.weight *
           (v_[share.node] + fall +
            step.kick / model_->mass[share.node] * body().force(body().place(share.node)));
  return sum;
}

}  // namespace springlod::sim
