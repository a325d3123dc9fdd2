#pragma once

#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Gives each material of a level the sum of k L^2 that it has in the base, and with it the Young's
/// modulus of eq. 2 of the paper; a spring between two materials belongs half to each. For
/// comparison: it leaves the frequencies worse than it found them (spec 4).
void rescale_moduli(const MassSpringModel& base, MassSpringModel& level);

}  // namespace springlod::lod
