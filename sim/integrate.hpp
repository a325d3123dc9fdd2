#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact.hpp"
#include "sim/ledger.hpp"
#include "sim/run.hpp"

namespace springlod {

/// The moving part of a run, as leapfrog sees it: positions x_n at whole steps, velocities half a
/// step before and after.
///
///   kick:   v+ = v- + dt (F(x_n, w_n) / m + g), then friction takes its part of the slip
///   drift:  x_{n+1} = x_n + dt v+
///
/// Both integrators are this scheme; they differ in the velocity w_n that damping sees:
/// - symplectic_euler: w_n = v-, the old velocity. Damping is first order in dt; the limit is
///   dt = -beta + sqrt(beta^2 + 4/omega^2).
/// - velocity_verlet: w_n = v- + (v- - v--) / 2, the velocity extrapolated to x_n. Damping is
/// second
///   order; the limit is that of twice the damping time, dt = -2 beta + sqrt(4 beta^2 + 4/omega^2)
///   (the root z = -1 of z^3 + (W + 3d/2 - 2) z^2 + (1 - 2d) z + d/2 with W = omega^2 dt^2,
///   d = beta omega^2 dt; the Jury conditions for the other roots are weaker).
/// Without damping the two are the same. The start v_{-1/2} = v_0 - dt/2 F(x_0, v_0)/m makes both
/// second order in the elastic forces and puts x_n of a free flight exactly on the parabola.
class Leapfrog {
 public:
  Leapfrog(const MassSpringModel& model, const Scenario& scenario, const State& start,
           Integrator integrator, double step);

  /// Takes v- to v+ at x_n and, with a ledger, books the first half of the step's losses.
  template <bool with_ledger>
  void kick();
  /// Takes x_n to x_{n+1} and books the second half.
  template <bool with_ledger>
  void drift();

  std::uint64_t step_number() const { return n_; }
  double time() const { return static_cast<double>(n_) * step_; }

  // Valid between kick and drift.
  const std::vector<Vec3>& positions() const { return x_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  /// x_n + (t - t_n) v+
  std::vector<Vec3> positions_at(double time) const;
  /// x_n and the mean of v- and v+.
  State state() const;
  Vec3 center_of_mass() const;
  Vec3 center_velocity() const;  ///< from v+
  /// The energies of this instant and the losses so far; see ledger.hpp for what is exact.
  LedgerEntry ledger_entry() const;
  /// Sum of m v+ . v+ / 2 [J], and the node that has most of it.
  double kinetic_after(std::uint32_t* fastest) const;

 private:
  void find_forces(bool with_damping);
  /// Half of a step's losses, with the velocity v- (to_neighbour = -dt) or v+ (dt).
  void book_half_step(const std::vector<Vec3>& v, double to_neighbour);

  const MassSpringModel* model_;
  Vec3 gravity_;
  Integrator integrator_;
  double step_;
  std::uint64_t n_ = 0;
  double total_mass_ = 0;
  Vec3 first_center_;
  std::vector<Vec3> x_, v_minus_, v_plus_;
  std::vector<Vec3> v_damping_;  // w_n; unused by symplectic Euler
  std::vector<Vec3> force_, damping_force_;
  ContactFinder finder_;
  std::vector<Contact> contacts_;
  LedgerEntry losses_;
};

}  // namespace springlod
