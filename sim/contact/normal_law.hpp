#pragma once

namespace springlod::sim {

/// Energy of a contact of stiffness k at depth d: k d^2 / 2 inside the obstacle, 0 outside [J].
double penalty_energy(double stiffness, double depth);

/// Normal force between one point and an obstacle over one step: eq. 68 of docs/method.md.
///
/// The force is constant over the step. Its elastic part is the discrete gradient of the energy U
/// of the contact, (U(d_1) - U(d_0)) / (d_1 - d_0) for the depths d_0 at the start and d_1 at the
/// end (Gonzalez 1996, "Time integration and discrete Hamiltonian systems"), so the energy that it
/// takes out of the motion is the stored energy, for any step and stiffness. The damping force is
/// the contact damping times the mean rate of the part of the depth inside the obstacle. The sum
/// never pulls.
struct NormalLaw {
  double stiffness = 0;  ///< k [N/m] > 0
  double damping = 0;    ///< damping time of the contact over the length of the step [1] >= 0
  /// Displacement of the point by a unit force during the step, dt^2 / (2 m) [m/N] > 0.
  double mobility = 0;

  struct Result {
    double force = 0;  ///< [N] >= 0
    double depth = 0;  ///< at the end of the step [m]
  };
  /// `start`: depth at the start of the step [m], negative outside. `free`: depth at its end
  /// without the contact [m].
  Result solve(double start, double free) const;
};

}  // namespace springlod::sim
