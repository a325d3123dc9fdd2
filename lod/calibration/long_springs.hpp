#pragma once

#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Makes short springs softer and long ones stiffer, k *= L / mean L, then all of them by one
/// factor so that sum k L^2 stays; c keeps its part of k. A merge makes k L0 / L large where
/// centres come near each other, and those few springs decide the stable step (spec 4.1).
void favour_long_springs(MassSpringModel& model);

}  // namespace springlod::lod
