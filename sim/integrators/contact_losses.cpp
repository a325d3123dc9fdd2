#include "sim/integrators/contact_losses.hpp"

#include <cmath>

namespace springlod::sim {

void book_contact(const Contact& contact, double mass, double step, const Vec3& v,
                  double to_neighbour, LedgerEntry& losses) {
  const double speed = contact.normal.dot(v);
  losses.lost_contact -= 0.5 * step * contact.damping_force * speed;
  losses.lost_friction -= 0.5 * mass * contact.slip_change.dot(v);
  // Energy in the stick spring is lost only when the contact ends.
  if (to_neighbour < 0) losses.lost_friction -= contact.stick_gain;
  // No contact at the neighbouring step: the trapezoid rule does not resolve the kink of the force.
  const double gap = to_neighbour * speed - contact.depth;
  if (gap <= 0) return;
  losses.lost_contact -= std::copysign(0.5 * contact.stiffness * contact.depth * gap, to_neighbour);
  if (to_neighbour > 0) losses.lost_friction += contact.stick_energy();
}

}  // namespace springlod::sim
