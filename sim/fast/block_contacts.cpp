#include "sim/fast/block_contacts.hpp"

namespace springlod {
namespace {

/// World-axes bounds of a turned box.
Box3 bounds_of(const SolidBox& box) {
  const Vec3 reach = box.rotation.cwiseAbs() * box.half_size;
  return {box.center - reach, box.center + reach};
}

/// How far the box's lowest corner lies along a plane's normal [m].
double lowest(const Box3& box, const Vec3& normal) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis)
    sum += normal[axis] * (normal[axis] > 0 ? box.min()[axis] : box.max()[axis]);
  return sum;
}

Box3 moved(const Box3& box, const Vec3& way) {
  return {box.min() + way, box.max() + way};
}

}  // namespace

BlockContacts::BlockContacts(const MassSpringModel& model, const std::vector<Obstacle>& obstacles,
                             std::uint32_t block, FastBody& body, ContactFinder& finder,
                             TunnelWatch& walls)
    : model_(&model),
      obstacles_(&obstacles),
      block_(block),
      body_(&body),
      finder_(&finder),
      walls_(&walls),
      was_near_(obstacles.size(), 0) {
  const std::vector<std::uint32_t>& nodes = finder.nodes();
  for (std::uint32_t number = 0; number < nodes.size(); ++number)
    if (body.place(nodes[number]).block == block) numbers_.push_back(number);
}

bool BlockContacts::is_near(std::size_t obstacle, const Box3& bounds) const {
  const Obstacle& thing = (*obstacles_)[obstacle];
  if (const auto* plane = std::get_if<Plane>(&thing.shape))
    return lowest(bounds, plane->normal) < plane->offset;
  return bounds_of(std::get<SolidBox>(thing.shape)).intersects(bounds);
}

void BlockContacts::press(std::uint64_t n, const MovingFrame& frame, double step) {
  contacts_.clear();
  if (numbers_.empty()) return;
  const Box3 bounds = moved(body_->bounds(block_), frame.origin);
  for (std::size_t o = 0; o < obstacles_->size(); ++o) {
    const bool near = is_near(o, bounds);
    const bool new_here = near && was_near_[o] == 0;
    was_near_[o] = near ? 1 : 0;
    if (!near) continue;
    for (const std::uint32_t number : numbers_) {
      const Place at = body_->place(finder_->nodes()[number]);
      const Vec3 x = frame.origin + body_->x(at);
      const Vec3 v = frame.velocity + body_->v(at);
      if (new_here) finder_->take_sides(o, number, x - step * v);
      const std::optional<Contact> contact = finder_->find_one(o, number, x, v);
      if (!contact) continue;
      contacts_.push_back(*contact);
      body_->add_force(at, contact->normal_force * contact->normal);
    }
  }
  if (!first_step_ && !contacts_.empty()) first_step_ = n;
}

void BlockContacts::rub(const MovingFrame& frame, double step) {
  for (Contact& c : contacts_) {
    c.slip_change = friction_slip_change(c, model_->mass[c.node], step, velocity(c, frame));
    body_->add_velocity(body_->place(c.node), c.slip_change);
  }
}

void BlockContacts::watch(std::uint64_t n, const MovingFrame& before, const MovingFrame& after,
                          double step) {
  if (walls_->wall_count() == 0 || numbers_.empty()) return;
  const Box3 swept =
      moved(bounds_before_, before.origin).merged(moved(body_->bounds(block_), after.origin));
  for (std::size_t w = 0; w < walls_->wall_count(); ++w) {
    if (!bounds_of(walls_->wall(w)).intersects(swept)) continue;
    for (const std::uint32_t number : numbers_) {
      const Place at = body_->place(walls_->nodes()[number]);
      const Vec3 to = after.origin + body_->x(at);
      const Vec3 from = to - step * (before.velocity + body_->v(at));
      if (!walls_->goes_through(w, number, from, to) || passage_) continue;
      passage_ = Passage{n, w, number, from, to};
    }
  }
}

Vec3 BlockContacts::velocity(const Contact& contact, const MovingFrame& frame) const {
  return frame.velocity + body_->v(body_->place(contact.node));
}

}  // namespace springlod
