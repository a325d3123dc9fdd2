#pragma once

#include <vector>

#include "model/mass_spring.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Orientations of a rigid body with the mass and inertia of the model at rest, that starts with
/// the rotation and the spin of `start` and rotates freely: at the times 0, 1 / rate, ... up to
/// `end` [s].
std::vector<Mat3> free_rotation(const MassSpringModel& model, const Throw& start, double end,
                                double rate);

/// RMS distance of the nodes of `base` between its own free rotation and that of `level`, averaged
/// over these times [m].
double rotation_difference(const MassSpringModel& base, const MassSpringModel& level,
                           const Throw& start, double end, double rate);

}  // namespace springlod::sim
