#include "sim/fast/fast_contacts.hpp"

#include <algorithm>

namespace springlod::sim {

FastContacts::FastContacts(const Shared& shared, std::uint32_t number_count)
    : shared_(shared), solver_(*shared.points, *shared.finder, number_count) {}

void FastContacts::apply(const Step& step) {
  for (const NodeChange& change : solver_.changes())
    body().shift(body().place(change.node), change.displacement, change.kick);
  if (!first_step_ && !now().empty()) first_step_ = step.number;
  if (!shared_.with_ledger) return;
  losses_.contact += solver_.losses().contact;
  losses_.friction += solver_.losses().friction;
  for (const NodeChange& change : solver_.changes()) {
    losses_.contact += half_work(change.node, change.by_pressure(step.length));
    losses_.friction += half_work(change.node, change.by_friction(step.length));
  }
  booked_step_ = step.length;
}

void FastContacts::book_end() {
  if (booked_step_ == 0) return;
  for (const NodeChange& change : solver_.changes())
    losses_.contact -= half_work(change.node, change.by_pressure(booked_step_));
  booked_step_ = 0;
}

// See LedgerEntry. The damping forces take their own part.
double FastContacts::half_work(std::uint32_t node, const Vec3& displacement) const {
  const Place at = body().place(node);
  const Vec3 force =
      body().force(at) - body().damping_force(at) + model().mass[node] * shared_.gravity;
  return 0.5 * force.dot(displacement);
}

bool FastContacts::near_wall(const Box3& swept) const {
  for (std::size_t w = 0; w < shared_.walls->wall_count(); ++w)
    if (bounds_of(shared_.walls->wall(w)).intersects(swept)) return true;
  return false;
}

void FastContacts::check_wall(const Passage& passage) {
  if (shared_.walls->goes_through(passage.wall, passage.number, passage.from, passage.to) &&
      !passage_)
    passage_ = passage;
}

}  // namespace springlod::sim
