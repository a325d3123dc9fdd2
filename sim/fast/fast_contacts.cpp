#include "sim/fast/fast_contacts.hpp"

#include "sim/integrators/contact_losses.hpp"

namespace springlod::sim {

bool FastContacts::add_contact(std::size_t obstacle, std::uint32_t point, const Motion& motion) {
  const std::optional<Contact> contact = finder().find_one(obstacle, point, motion.x, motion.v);
  if (!contact) return false;
  contacts_.push_back(*contact);
  for (const ContactPoints::Share& share : points().shares(point))
    body().add_force(body().place(share.node),
                     share.weight * contact->normal_force * contact->normal);
  return true;
}

void FastContacts::add_friction(const Step& step) {
  if (!first_step_ && !contacts_.empty()) first_step_ = step.number;
  for (Contact& c : contacts_) {
    const double mass = points().mass(c.point);
    rub(c, mass, step.length, kicked_velocity(c, step));
    for (const ContactPoints::Share& share : points().shares(c.point))
      body().add_force(body().place(share.node), share.weight * mass / step.kick * c.slip_change);
  }
}

void FastContacts::check_wall(const Passage& way) {
  if (walls().goes_through(way.wall, way.number, way.from, way.to) && !passage_) passage_ = way;
}

void FastContacts::book_before_kick(double length, LedgerEntry& losses) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    book_contact(contacts_[i], points().mass(contacts_[i].point), length, velocity_before_kick(i),
                 -length, losses);
}

void FastContacts::book_after_kick(double length, LedgerEntry& losses) const {
  for (std::size_t i = 0; i < contacts_.size(); ++i)
    book_contact(contacts_[i], points().mass(contacts_[i].point), length, velocity_after_kick(i),
                 length, losses);
}

}  // namespace springlod::sim
