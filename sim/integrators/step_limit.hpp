#pragma once

#include <limits>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/step_bound.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// Stable time step of an explicit scheme. Infinite for the implicit schemes, and if there is no
/// stiffness.
struct StepLimit {
  double step = std::numeric_limits<double>::infinity();             ///< [s]
  double without_damping = std::numeric_limits<double>::infinity();  ///< without damping [s]

  double omega = 0;         ///< highest frequency of springs and contacts [rad/s]
  double damping_time = 0;  ///< largest of springs and obstacles [s]
  /// Largest stiffness that obstacles add to each node [N/m]; empty for the implicit schemes.
  std::vector<double> ground_stiffness = {};

  StepBound limited_by() const { return stable_step_bound(step, without_damping); }
};

/// Follows from the highest frequency of the model and the largest damping time of springs and
/// obstacles: see stable_step. The frequency includes the contact stiffness of nodes with a contact
/// area. Velocity Verlet counts damping twice (see Leapfrog), Runge-Kutta has its own limit.
/// `skin`: where the body touches obstacles; null: at its nodes.
StepLimit step_limit(const MassSpringModel& model, const Scenario& scenario,
                     Integrator integrator = Integrator::symplectic_euler,
                     const ContactSkin* skin = nullptr);

/// step_limit(...).step [s].
double predicted_step(const MassSpringModel& model, const Scenario& scenario,
                      Integrator integrator = Integrator::symplectic_euler,
                      const ContactSkin* skin = nullptr);

}  // namespace springlod::sim
