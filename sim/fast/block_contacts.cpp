#include "sim/fast/block_contacts.hpp"

#include <limits>
#include <utility>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Number of a node without contact area.
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

// Regions are widened by this fraction of the block's size [1], so that rounding to single
// precision leaves no node out.
constexpr double kRounding = 1e-6;

}  // namespace

BlockContacts::BlockContacts(const Shared& shared, std::uint32_t block,
                             std::vector<std::uint32_t> numbers)
    : FastContacts(shared), block_(block), numbers_(std::move(numbers)) {
  for (const std::uint32_t number : numbers_) {
    const std::uint32_t index = place(number).index;
    if (number_of_.size() <= index) number_of_.resize(index + 1, kNone);
    number_of_[index] = number;
  }
  checked_at_.assign(obstacles().size(), std::vector<std::uint64_t>(number_of_.size(), 0));
}

void BlockContacts::apply(const Step& step) {
  frame_velocity_ = step.frame.velocity;
  kicked_frame_velocity_ = step.kicked.velocity;
  contacts_.clear();
  if (numbers_.empty()) return;
  find_contacts(step);
  add_friction(step);
  note_first(step);
}

void BlockContacts::add_friction(const Step& step) {
  for (Contact& c : contacts_) {
    const Place at = place(c.point);
    const double mass = points().mass(c.point);
    const Vec3 kicked = step.kicked.velocity + body().v(at) + step.kick / mass * body().force(at);
    apply_friction(c, mass, step.length, kicked);
    body().add_force(at, mass / step.kick * c.slip_change);
  }
}

void BlockContacts::find_contacts(const Step& step) {
  const Box3& bounds = body().bounds(block_);
  const Vec3& origin = step.frame.origin;
  const Vec3 margin = Vec3::Constant(kRounding * bounds.sizes().maxCoeff());
  for (std::size_t o = 0; o < obstacles().size(); ++o) {
    const Box3 near = region_touching(obstacles()[o], moved(bounds, origin));
    if (near.isEmpty()) continue;
    found_.clear();
    body().nodes_in(block_, Box3(near.min() - origin - margin, near.max() - origin + margin),
                    found_);
    for (const std::uint32_t index : found_) find_contact(step, o, index);
  }
}

void BlockContacts::find_contact(const Step& step, std::size_t obstacle, std::uint32_t index) {
  if (index >= number_of_.size() || number_of_[index] == kNone) return;
  const std::uint32_t number = number_of_[index];
  const Place at{block_, index};
  const Vec3 x = step.frame.origin + body().x(at);
  const Vec3 v = step.frame.velocity + body().v(at);
  std::uint64_t& checked_at = checked_at_[obstacle][index];
  // Skipped if the step is repeated with another length: the node may be inside by now.
  if (checked_at != step.number && checked_at != step.number + 1)
    finder().take_sides(obstacle, number, x - step.length * v);
  checked_at = step.number + 1;
  if (const Contact* contact = add_contact(obstacle, number, {x, v}))
    body().add_force(at, contact->normal_force * contact->normal);
}

void BlockContacts::end_drift(std::uint64_t n, const MovingFrame& before, const MovingFrame& after,
                              double length) {
  if (walls().wall_count() == 0 || numbers_.empty()) return;
  const Box3 swept =
      moved(bounds_before_, before.origin).merged(moved(body().bounds(block_), after.origin));
  check_walls(n, length, swept, numbers_, [&](std::uint32_t number) {
    const Place at = place(number);
    return Motion{after.origin + body().x(at), before.velocity + body().v(at)};
  });
}

Vec3 BlockContacts::velocity(const Contact& contact, const Vec3& of_frame) const {
  return of_frame + body().v(place(contact.point));
}

Vec3 BlockContacts::velocity_before_kick(std::size_t contact) const {
  return velocity(now()[contact], frame_velocity_);
}

Vec3 BlockContacts::velocity_after_kick(std::size_t contact) const {
  return velocity(now()[contact], kicked_frame_velocity_);
}

}  // namespace springlod::sim
