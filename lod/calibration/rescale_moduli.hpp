#pragma once

#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Rescales k and c of each material so that its sum of k L^2, and with it Young's modulus by eq. 2
/// of docs/method.md, is that of the base (eq. 47 there): exactly, if no spring joins two
/// materials. Such a spring counts half for each. For comparison only: the errors of the
/// frequencies grow (docs/accuracy.md).
void rescale_moduli(const MassSpringModel& base, MassSpringModel& level);

}  // namespace springlod::lod
