#pragma once

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// Angular velocity of the rigid motion that has the angular momentum of `state` about its centre
/// of mass [rad/s]; for nodes on a straight line, without the component about the line.
Vec3 angular_velocity(const MassSpringModel& model, const State& state);

}  // namespace springlod::sim
