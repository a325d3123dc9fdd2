#pragma once

#include "sim/contact/contact.hpp"
#include "sim/integrators/ledger.hpp"

namespace springlod::sim {

/// Half of the energy that leapfrog loses to one contact in a step of length `step` [s]. `v` is the
/// velocity of its point half a step before (to_neighbour = -step) or after (to_neighbour = step):
/// see LedgerEntry.
void book_contact(const Contact& contact, double mass, double step, const Vec3& v,
                  double to_neighbour, LedgerEntry& losses);

}  // namespace springlod::sim
