#pragma once

#include <vector>

#include "model/vec.hpp"
#include "sim/contact/step_contacts.hpp"

namespace springlod::sim {

/// Applies the contacts of a step of length `step` [s] to a body that took it without contact: from
/// positions x to `x_next`, with the velocities `v_next` at its end. All points are checked.
void correct_step(const ContactPoints& points, std::size_t obstacle_count, double step,
                  const std::vector<Vec3>& x, StepContacts& contacts, std::vector<Vec3>& x_next,
                  std::vector<Vec3>& v_next);

}  // namespace springlod::sim
