#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "model/mass_spring.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/step_bound.hpp"

namespace springlod::sim {

/// Stable time step of an explicit scheme. Infinite for the implicit schemes, and if there is no
/// stiffness.
struct StepLimit {
  double step = std::numeric_limits<double>::infinity();             ///< [s]
  double without_damping = std::numeric_limits<double>::infinity();  ///< without damping [s]

  double omega = 0;         ///< highest frequency of the springs [rad/s]
  double damping_time = 0;  ///< largest of the springs [s]

  StepBound limited_by() const { return stable_step_bound(step, without_damping); }
};

/// Follows from the highest frequency of the model and the largest damping time of its springs: see
/// stable_step. Velocity Verlet counts damping twice (see Leapfrog), Runge-Kutta has its own limit.
/// Contacts and corners do not bound the step: see StepCorrection. `held`: nodes that do not move
/// by themselves; the limit with them is that of the free model or longer.
StepLimit step_limit(const MassSpringModel& model,
                     Integrator integrator = Integrator::symplectic_euler,
                     std::span<const std::uint32_t> held = {});

/// step_limit(...).step [s].
double predicted_step(const MassSpringModel& model,
                      Integrator integrator = Integrator::symplectic_euler,
                      std::span<const std::uint32_t> held = {});

}  // namespace springlod::sim
