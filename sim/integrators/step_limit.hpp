#pragma once

#include <limits>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/contact_skin.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/scenario.hpp"

namespace springlod::sim {

/// How long a step an explicit scheme can take. Infinite for the implicit schemes and if nothing is
/// stiff.
struct StepLimit {
  double step = std::numeric_limits<double>::infinity();             ///< [s]
  double without_damping = std::numeric_limits<double>::infinity();  ///< if nothing were damped [s]

  double omega = 0;         ///< highest frequency of springs and contacts [rad/s]
  double damping_time = 0;  ///< largest of springs and obstacles [s]
  /// What obstacles may add to the stiffness of each node [N/m]; empty for the implicit schemes.
  std::vector<double> ground_stiffness = {};

  /// Whether damping, and not how stiff springs and contacts are, costs most of the step.
  bool set_by_damping() const;
};

/// From the highest frequency of the model, with the contact stiffness of the nodes with an area
/// added to the springs, and the largest damping time of springs and obstacles: see stable_step.
/// Velocity Verlet counts damping twice (see Leapfrog), Runge-Kutta has its own limit.
/// `skin`: where the body touches obstacles; null: at its nodes.
StepLimit step_limit(const MassSpringModel& model, const Scenario& scenario,
                     Integrator integrator = Integrator::symplectic_euler,
                     const ContactSkin* skin = nullptr);

/// step_limit(...).step [s].
double predicted_step(const MassSpringModel& model, const Scenario& scenario,
                      Integrator integrator = Integrator::symplectic_euler,
                      const ContactSkin* skin = nullptr);

}  // namespace springlod::sim
