#pragma once

#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Makes short springs softer and long ones stiffer: k *= L / mean L, then one factor on all
/// springs that conserves sum k L^2; c / k is kept (docs/method.md, eq. 28). A merge gives springs
/// between close centroids a large k L0 / L, and those few springs determine the stable step.
void favour_long_springs(MassSpringModel& model);

}  // namespace springlod::lod
