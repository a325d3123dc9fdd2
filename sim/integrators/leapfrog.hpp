#pragma once

#include <cstdint>
#include <vector>

#include "sim/correction/plain_correction.hpp"
#include "sim/integrators/stepper.hpp"

namespace springlod::sim {

/// The state of a run under leapfrog: positions x_n at whole steps, velocities half a step before
/// and after.
///
///   kick:     v+ = v- + dt (F(x_n, w_n) / m + g)
///   drift:    x_{n+1} = x_n + dt v+
///   correct:  x_{n+1} += dx, v- of the next step = v+ + dv: see StepCorrection
///
/// Both integrators are this scheme; they differ in the velocity w_n that the damping force uses:
/// - symplectic_euler: w_n = v-, the old velocity. Damping is first order in dt; the limit is
///   dt = -beta + sqrt(beta^2 + 4/omega^2).
/// - velocity_verlet: w_n = v- + (v- - v--) / 2, extrapolated to x_n. Damping is second
///   order; the limit is that of twice the damping time, dt = -2 beta + sqrt(4 beta^2 + 4/omega^2)
///   (the root z = -1 of z^3 + (W + 3d/2 - 2) z^2 + (1 - 2d) z + d/2 with W = omega^2 dt^2,
///   d = beta omega^2 dt; the Jury conditions for the other roots are weaker).
/// Without damping the two are the same. The start v_{-1/2} = v_0 - dt/2 F(x_0, v_0)/m makes both
/// second order in the elastic forces and puts x_n of a free flight exactly on the parabola.
class Leapfrog final : public StepByStep {
 public:
  Leapfrog(const MassSpringModel& model, const Scenario& scenario, const State& start, double step,
           const StepperOptions& options);

  /// Takes v- to v+ at x_n, and corrects the step to x_{n+1}.
  void prepare() override;

  std::uint64_t spring_updates() const override { return n_ * model_->spring_count(); }
  /// x_n + (t - t_n) v+
  std::vector<Vec3> positions_at(double time) const override;
  /// x_n and the mean of v- and v+.
  State state() const override;
  /// The energies of this instant and the losses so far; see ledger.hpp for what is exact.
  LedgerEntry ledger_entry() const override;

 private:
  /// Takes x_n to x_{n+1}.
  void commit() override;
  const std::vector<Vec3>& step_velocities() const override { return v_step_; }
  double anchor_work() const override { return anchor_forces_.work() + anchor_half_work_; }
  void find_forces(bool with_damping);
  /// Gives the held nodes the step of their anchors, and finds the forces of these.
  void hold_nodes();
  /// Adds what the anchors do in the step, half of which they do with the forces of its start.
  void book_anchors();
  /// Half of the damping losses of a step, with the velocity v- or v+.
  void book_damping(const std::vector<Vec3>& v);
  double half_spring_work() const;
  /// The losses of the correction of the next step; book_end: their part that depends on the forces
  /// at its end, one step later.
  void book_correction();
  void book_end();
  /// Half the work of the elastic forces and of gravity on a node over a displacement [J].
  double half_work(std::uint32_t node, const Vec3& displacement) const;

  Integrator integrator_;
  bool with_ledger_;
  bool books_scheme_;  // symplectic Euler does not: see LedgerEntry
  bool volumes_;
  std::vector<Vec3> v_minus_, v_plus_;
  std::vector<Vec3> v_damping_;  // w_n; unused by symplectic Euler
  std::vector<Vec3> force_, damping_force_;
  std::vector<Vec3> anchor_force_;  // at x_n, by held node [N]
  double anchor_half_work_ = 0;     // of these over the second half of the last step [J]
  PlainCorrection correction_;
  std::vector<Vec3> v_step_;
  std::vector<Vec3> x_next_, v_next_;  // at the end of the step that prepare() computed
  double elastic_ = 0;                 // energy of the springs at x_n [J]
  // Energy at x_n of the corners that resist, as far as the losses contain it; the next step books
  // that of corners which others have pressed since they were checked [J].
  double booked_corners_;
  double anchor_energy_ = 0;  // of the springs of anchors at x_n [J]
  LedgerEntry losses_;
};

}  // namespace springlod::sim
