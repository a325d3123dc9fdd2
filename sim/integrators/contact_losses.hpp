#pragma once

#include "sim/contact/contact.hpp"
#include "sim/integrators/ledger.hpp"

namespace springlod::sim {

/// Half of what leapfrog loses to one contact in a step of length `step` [s], with the velocity `v`
/// of its point half a step before (to_neighbour = -step) or after (step): see LedgerEntry.
void book_contact(const Contact& contact, double mass, double step, const Vec3& v,
                  double to_neighbour, LedgerEntry& losses);

}  // namespace springlod::sim
