#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// The test motion of the schemes. The body starts from its rest shape, with velocities that
/// stretch it along its longest side, bend it and rotate it slowly. The motion is smooth, so that
/// fine and coarse models of the body resolve it. It is small (strains of about 1 %) and short, so
/// that it does not become chaotic. Its time scale is that of the body's slowest mode.
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

/// The initial state of a model of any level. Its centre of mass stays at rest. With anchored nodes
/// it neither rotates nor drifts, and the speed rises smoothly with the distance from these.
State probe_state(const MassSpringModel& model, const ProbeMotion& motion,
                  const std::vector<std::uint32_t>& anchored = {});

}  // namespace springlod::sim
