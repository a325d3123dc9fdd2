#pragma once

#include <cstdint>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// The motion by which schemes are probed: the body at rest in shape, with velocities that stretch
/// it along its longest side, bend it across, and turn it slowly. Smooth, so that every model of
/// the body, fine or coarse, resolves it; small (strains of about 1 %) and short, so that it does
/// not turn chaotic; and all of it at the body's own slow pace.
struct ProbeMotion {
  Vec3 center = Vec3::Zero();   ///< centre of mass of the base [m]
  Vec3 along = Vec3::UnitX();   ///< axis of the longest side
  Vec3 across = Vec3::UnitY();  ///< axis of the next one
  double half_length = 1;       ///< of the longest side [m]
  double speed = 0;             ///< of stretching and bending at the ends [m/s]
  Vec3 spin = Vec3::Zero();     ///< [rad/s]
  double duration = 1;          ///< [s]
};

/// For a base whose slowest mode has the angular frequency `omega` [rad/s], over `duration` [s].
ProbeMotion probe_motion(const MassSpringModel& base, double omega, double duration);

/// The start of a model, of whatever level. Its centre of mass rests.
State probe_state(const MassSpringModel& model, const ProbeMotion& motion);

}  // namespace springlod::sim
