#include "sim/fast/block_contacts.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Nodes without an area have no number.
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Regions are widened by this part of the block's size [1], so that rounding to single precision
// leaves none out.
constexpr double kRounding = 1e-6;

}  // namespace

BlockContacts::BlockContacts(const ContactPoints& points, const std::vector<Obstacle>& obstacles,
                             std::uint32_t block, std::vector<std::uint32_t> numbers,
                             FastBody& body, ContactFinder& finder, TunnelWatch& walls)
    : points_(&points),
      obstacles_(&obstacles),
      block_(block),
      body_(&body),
      finder_(&finder),
      walls_(&walls),
      numbers_(std::move(numbers)) {
  for (const std::uint32_t number : numbers_) {
    const std::uint32_t index = place(number).index;
    if (number_of_.size() <= index) number_of_.resize(index + 1, kNone);
    number_of_[index] = number;
  }
  looked_at_.assign(obstacles.size(), std::vector<std::uint64_t>(number_of_.size(), 0));
}

void BlockContacts::press(std::uint64_t n, const MovingFrame& frame, double step) {
  contacts_.clear();
  if (numbers_.empty()) return;
  const Box3& bounds = body_->bounds(block_);
  const Vec3 margin = Vec3::Constant(kRounding * bounds.sizes().maxCoeff());
  for (std::size_t o = 0; o < obstacles_->size(); ++o) {
    const Box3 near = region_touching((*obstacles_)[o], moved(bounds, frame.origin));
    if (near.isEmpty()) continue;
    found_.clear();
    body_->nodes_in(block_,
                    Box3(near.min() - frame.origin - margin, near.max() - frame.origin + margin),
                    found_);
    for (const std::uint32_t index : found_) press_node(n, o, index, frame, step);
  }
  if (!first_step_ && !contacts_.empty()) first_step_ = n;
}

void BlockContacts::press_node(std::uint64_t n, std::size_t obstacle, std::uint32_t index,
                               const MovingFrame& frame, double step) {
  if (index >= number_of_.size() || number_of_[index] == kNone) return;
  const std::uint32_t number = number_of_[index];
  const Place at{block_, index};
  const Vec3 x = frame.origin + body_->x(at);
  const Vec3 v = frame.velocity + body_->v(at);
  std::uint64_t& looked_at = looked_at_[obstacle][index];
  // Not where the step is made once more, shorter: the node may be inside by now.
  if (looked_at != n && looked_at != n + 1) finder_->take_sides(obstacle, number, x - step * v);
  looked_at = n + 1;
  const std::optional<Contact> contact = finder_->find_one(obstacle, number, x, v);
  if (!contact) return;
  contacts_.push_back(*contact);
  body_->add_force(at, contact->normal_force * contact->normal);
}

void BlockContacts::rub(const MovingFrame& frame, double kick, double step) {
  for (Contact& c : contacts_) {
    const Place at = place(c.point);
    const double mass = points_->mass(c.point);
    const Vec3 kicked = velocity(c, frame) + kick / mass * body_->force(at);
    sim::rub(c, mass, step, kicked);
    body_->add_force(at, mass / kick * c.slip_change);
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
      const Place at = place(number);
      const Vec3 to = after.origin + body_->x(at);
      const Vec3 from = to - step * (before.velocity + body_->v(at));
      if (!walls_->goes_through(w, number, from, to) || passage_) continue;
      passage_ = Passage{n, w, number, from, to};
    }
  }
}

Vec3 BlockContacts::velocity(const Contact& contact, const MovingFrame& frame) const {
  return frame.velocity + body_->v(place(contact.point));
}

}  // namespace springlod::sim
