#include "sim/fast/skin_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Bounds and ways are widened by this part [1], so that rounding to single precision leaves no
// point out.
constexpr double kRounding = 1e-6;

}  // namespace

SkinContacts::SkinContacts(const MassSpringModel& model, const ContactPoints& points,
                           const std::vector<Obstacle>& obstacles, FastBody& body,
                           ContactFinder& finder, TunnelWatch& walls)
    : model_(&model),
      points_(&points),
      obstacles_(&obstacles),
      body_(&body),
      finder_(&finder),
      walls_(&walls),
      x_(model.rest),
      v_(model.node_count(), Vec3::Zero()),
      views_(obstacles.size()) {
  for (std::uint32_t p = 0; p < points.count(); ++p) reach_ = std::max(reach_, points.reach(p));
  for (View& view : views_) view.due.resize(points.count());
}

void SkinContacts::act(const Step& step) {
  const bool arrives = arrived_ != step.number;
  if (!arrives && step.kick == 0) return;
  const Box3 here = bounds(step.frame);
  const Box3 swept = arrived_ ? here.merged(bounds_) : here;
  const bool near = near_anything(swept);
  if (near)
    for (std::uint32_t b = 0; b < body_->block_count(); ++b) {
      body_->get_x(b, step.frame, x_);
      body_->get_v(b, step.frame, v_);
    }
  bounds_ = here;
  if (arrives) arrive(step, near, swept);
  if (step.kick == 0) return;
  // The step may be made once more, shorter: then the one before is still the one before.
  if (kicked_ != step.number) contacts_before_ = std::move(contacts_);
  kicked_ = step.number;
  contacts_.clear();
  if (near)
    for (std::size_t o = 0; o < obstacles_->size(); ++o) press(step, o);
  keep_grips(contacts_before_, contacts_);
  if (!first_step_ && !contacts_.empty()) first_step_ = step.number;
  rub(step);
}

// A point lies at most its reach times half the size of the nodes' box from the middle of that.
Box3 SkinContacts::bounds(const MovingFrame& frame) const {
  Box3 nodes;
  for (std::uint32_t b = 0; b < body_->block_count(); ++b) nodes.extend(body_->bounds(b));
  const Vec3 half = (1 + kRounding) * reach_ / 2 * nodes.sizes();
  return moved(Box3(nodes.center() - half, nodes.center() + half), frame.origin);
}

bool SkinContacts::near_anything(const Box3& region) const {
  return std::any_of(obstacles_->begin(), obstacles_->end(), [&](const Obstacle& obstacle) {
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
  watch(step, swept);
}

void SkinContacts::watch(const Step& step, const Box3& swept) {
  for (std::size_t w = 0; w < walls_->wall_count(); ++w) {
    if (!bounds_of(walls_->wall(w)).intersects(swept)) continue;
    for (std::uint32_t p = 0; p < points_->count(); ++p) {
      const Vec3 to = points_->carried(p, x_);
      const Vec3 from = to - step.length * points_->carried(p, v_);
      if (!walls_->goes_through(w, p, from, to) || passage_) continue;
      passage_ = Passage{step.number, w, p, from, to};
    }
  }
}

void SkinContacts::press(const Step& step, std::size_t obstacle) {
  const Obstacle& thing = (*obstacles_)[obstacle];
  if (region_touching(thing, bounds_).isEmpty()) return;
  View& view = views_[obstacle];
  const bool afresh = !view.last || *view.last + 1 < step.number;
  // The step is made once more, shorter: what is inside by now came from the sides it has.
  const bool again = view.last == step.number;
  view.last = step.number;
  for (std::uint32_t p = 0; p < points_->count(); ++p) {
    if (!afresh && travel_ < view.due[p]) continue;
    const Vec3 x = points_->carried(p, x_);
    const Vec3 v = points_->carried(p, v_);
    if (afresh || (!again && travel_before_ < view.due[p]))
      finder_->take_sides(obstacle, p, x - step.length * v);
    const std::optional<Contact> contact = finder_->find_one(obstacle, p, x, v);
    view.due[p] = travel_;
    if (!contact) {
      view.due[p] += std::max(0.0, surface_distance(thing, x).distance) / points_->reach(p);
      continue;
    }
    contacts_.push_back(*contact);
    for (const ContactPoints::Share& share : points_->shares(p))
      body_->add_force(body_->place(share.node),
                       share.weight * contact->normal_force * contact->normal);
  }
}

void SkinContacts::rub(const Step& step) {
  before_.clear();
  after_.clear();
  for (Contact& c : contacts_) {
    before_.push_back(points_->carried(c.point, v_));
    const double mass = points_->mass(c.point);
    sim::rub(c, mass, step.length, kicked_velocity(c, step));
    for (const ContactPoints::Share& share : points_->shares(c.point))
      body_->add_force(body_->place(share.node), share.weight * mass / step.kick * c.slip_change);
  }
  for (const Contact& c : contacts_) after_.push_back(kicked_velocity(c, step));
}

Vec3 SkinContacts::kicked_velocity(const Contact& contact, const Step& step) const {
  const Vec3 fall = step.kicked.velocity - step.frame.velocity;
  Vec3 sum = Vec3::Zero();
  for (const ContactPoints::Share& share : points_->shares(contact.point))
    sum += share.weight *
           (v_[share.node] + fall +
            step.kick / model_->mass[share.node] * body_->force(body_->place(share.node)));
  return sum;
}

}  // namespace springlod::sim
