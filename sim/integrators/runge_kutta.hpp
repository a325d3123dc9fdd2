#pragma once

#include <vector>

#include "sim/integrators/whole_step.hpp"

namespace springlod::sim {

/// The classical Runge-Kutta scheme of fourth order on (x, v): evaluates elastic and damping forces
/// at four points per step. (The order is lower in steps with contact, which is applied after the
/// step.)
class RungeKutta final : public WholeStep {
 public:
  RungeKutta(const MassSpringModel& model, const Scenario& scenario, const State& start,
             double step, const StepperOptions& options);

 private:
  void solve() override;
  /// Writes the acceleration at (x, v) to `a`; returns the power dissipated by damping [W].
  double accelerate(const std::vector<Vec3>& x, const std::vector<Vec3>& v, std::vector<Vec3>& a);

  /// Books a stage for the held nodes, and puts them where they are at the next, `next` steps
  /// later.
  void hold_stage(double weight, double next);
  void finish_held();

  std::vector<Vec3> x_stage_, v_stage_, acceleration_, damping_force_;
  std::vector<Vec3> held_force_, held_velocity_;  // in the present stage, by held node [N], [m/s]
};

/// Largest stable step of the scheme for springs of one damping time beta [s] and frequencies up to
/// omega_max [rad/s]: |1 + z + z^2/2 + z^3/6 + z^4/24| <= 1 for z = lambda dt, lambda the roots of
/// lambda^2 + beta omega^2 lambda + omega^2, at omega_max and at frequencies below it; 2.83 / omega
/// without damping. Infinite for omega_max = 0.
double runge_kutta_stable_step(double omega_max, double damping_time);

}  // namespace springlod::sim
