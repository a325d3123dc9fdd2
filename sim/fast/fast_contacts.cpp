#include "sim/fast/fast_contacts.hpp"

#include "sim/integrators/contact_losses.hpp"

namespace springlod::sim {

void FastContacts::check_wall(const Passage& passage) {
  if (walls().goes_through(passage.wall, passage.number, passage.from, passage.to) && !passage_)
    passage_ = passage;
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
