#include "sim/fast/block_contacts.hpp"

#include <algorithm>
#include <utility>

#include "sim/fast/regions.hpp"

namespace springlod::sim {
namespace {

// Regions are widened by this fraction of the block's size [1], so that rounding to single
// precision leaves no node out.
constexpr double kRounding = 1e-6;

std::uint32_t index_count(const FastBody& body, const ContactPoints& points,
                          const std::vector<std::uint32_t>& numbers) {
  std::uint32_t count = 0;
  for (const std::uint32_t number : numbers)
    count = std::max(count, body.place(points.number(number)).index + 1);
  return count;
}

}  // namespace

BlockContacts::BlockContacts(const Shared& shared, std::uint32_t block,
                             std::vector<std::uint32_t> numbers)
    : FastContacts(shared, index_count(*shared.body, *shared.points, numbers)),
      block_(block),
      numbers_(std::move(numbers)),
      number_of_(index_count(body(), points(), numbers_), kNone),
      checked_at_(obstacles().size(), std::vector<std::uint64_t>(number_of_.size(), 0)),
      before_(obstacles().size(), std::vector<std::uint32_t>(number_of_.size(), kNone)) {
  for (const std::uint32_t number : numbers_) number_of_[place(number).index] = number;
}

void BlockContacts::correct(const Step& step) {
  if (numbers_.empty() || obstacles().empty()) return;
  const Box3 swept = moved(bounds_before_, step.before.origin)
                         .merged(moved(body().bounds(block_), step.after.origin));
  const bool at_wall = near_wall(swept);
  if (at_wall) {
    from_.clear();
    for (const std::uint32_t number : numbers_) from_.push_back(path(step, place(number)).from);
  }
  solver().begin(step.length);
  note_contacts_before();
  for (std::uint32_t o = 0; o < obstacles().size(); ++o) check_nodes(step, o);
  solve(
      step, [&](std::uint32_t node) { return path(step, body().place(node)); },
      [&](std::uint32_t node) { return body().place(node).index; });
  if (!at_wall) return;
  auto from = from_.begin();
  check_walls(step.number, numbers_, [&](std::uint32_t number) {
    if (from == from_.end()) from = from_.begin();  // the next wall
    return StepContacts::Path{*from++, step.after.origin + body().x(place(number))};
  });
}

void BlockContacts::note_contacts_before() {
  const std::vector<Contact>& contacts = solver().before();
  for (std::uint32_t i = 0; i < contacts.size(); ++i)
    before_[contacts[i].obstacle][place(contacts[i].point).index] = i;
}

void BlockContacts::check_nodes(const Step& step, std::uint32_t obstacle) {
  const Box3& bounds = body().bounds(block_);
  const Vec3& origin = step.after.origin;
  const Box3 near = region_touching(obstacles()[obstacle], moved(bounds, origin));
  if (!near.isEmpty()) {
    const Vec3 margin = Vec3::Constant(kRounding * bounds.sizes().maxCoeff());
    found_.clear();
    body().nodes_in(block_, Box3(near.min() - origin - margin, near.max() - origin + margin),
                    found_);
    for (const std::uint32_t index : found_)
      if (index < number_of_.size() && number_of_[index] != kNone)
        check_node(step, obstacle, index);
  }
  for (const Contact& contact : solver().before()) {
    const std::uint32_t index = place(contact.point).index;
    if (contact.obstacle == obstacle && before_[obstacle][index] != kNone)
      check_node(step, obstacle, index);
  }
}

void BlockContacts::check_node(const Step& step, std::uint32_t obstacle, std::uint32_t index) {
  const std::uint32_t number = number_of_[index];
  const StepContacts::Path of_node = path(step, {block_, index});
  std::uint64_t& checked_at = checked_at_[obstacle][index];
  if (checked_at != step.number) finder().take_sides(obstacle, number, of_node.from);
  checked_at = step.number + 1;
  std::uint32_t& before = before_[obstacle][index];
  const Contact* was = before == kNone ? nullptr : &solver().before()[before];
  before = kNone;
  solver().check(obstacle, number, was, of_node);
}

StepContacts::Path BlockContacts::path(const Step& step, Place at) const {
  const Vec3 to = step.after.origin + body().x(at);
  return {to - step.length * (step.after.velocity + body().v(at)), to};
}

}  // namespace springlod::sim
