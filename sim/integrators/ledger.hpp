#pragma once

#include <vector>

namespace springlod::sim {

/// Energies of a body and its losses until one time [J]: section 10 of docs/method.md. kinetic +
/// elastic + gravity + contact + anchors + the losses - the work of anchors = the initial sum.
/// Gravity counts from the initial height.
///
/// What is exact. With velocities v- and v+ half a step before and after x_n, the product
/// K_n = sum m v- . v+ / 2 obeys K_{n+1} - K_n = (F_n + F_{n+1}) . (x_{n+1} - x_n) / 2: the
/// trapezoid rule of the work. If forces are linear in x, K_n + U(x_n) is therefore conserved
/// except for rounding, for any step. If that sum is split by forces instead of by steps, a
/// dissipative force F_d loses -dt F_d . (v- + v+) / 2 per step (half of it in the first and the
/// last step). Every loss is computed from its own force, and none as the remainder of the others.
/// The sum of all entries is therefore an independent check.
///
/// lost_scheme is the error of a scheme in the steps without contacts and corners. Velocity Verlet
/// computes it from the springs: the trapezoid rule of their work is not exact if they rotate or
/// are strained much. Runge-Kutta computes it from the energies before and after such a step and
/// the work of damping in it, so that its sum checks contacts, friction and corners. Symplectic
/// Euler keeps the trapezoid error small by its step, and the implicit schemes cannot separate
/// their error from the contacts, which they solve with the springs: in both, it is the drift of
/// the sum.
///
/// Contacts take from the motion what they store or lose (NormalLaw), but the displacement of a
/// node that they push differs from the velocities at both ends of the step. By this discretization
/// error, proportional to dt, the forces of the scheme do work on it that the trapezoid rule does
/// not contain. It is recorded under lost_contact. The same holds for corners, under lost_corners,
/// and for the springs of anchors, under lost_anchors.
///
/// An anchor's force on a held node is what it takes, beyond the forces of the step, to give the
/// node the velocity of its path. Its work follows the same trapezoid rule; what contacts and
/// corners do to a held node in a step is taken up by the anchor over that step. An anchor on
/// springs works at the other end of these.
///
/// K_n is not a sum of squares: it lies below the kinetic energy of the mean velocity by
/// m |dt F/m|^2 / 8.
struct LedgerEntry {
  double time = 0;  ///< [s]
  double kinetic = 0;
  double elastic = 0;        ///< in springs and corners
  double gravity = 0;        ///< potential
  double contact = 0;        ///< stored in the penalty and stick springs
  double anchors = 0;        ///< stored in the springs of anchors
  double lost_damping = 0;   ///< to spring damping
  double lost_friction = 0;  ///< to sliding, and to the dampers of stick springs
  double lost_contact = 0;   ///< to contact damping and the discretization error of contacts
  double lost_corners = 0;   ///< to corner damping and the discretization error of corners
  double lost_anchors = 0;  ///< to dampers of anchors and the discretization error of their springs
  double lost_scheme = 0;   ///< to the error of the scheme; < 0: it gained energy
  double lost_switch = 0;   ///< to a change of the level, or of the step (K_n depends on it)
  double anchor_work = 0;   ///< done on the body by what holds it, so far
  /// The energy that can still become motion.
  double mechanical() const { return kinetic + elastic + gravity + contact + anchors; }
  double total() const {
    return mechanical() + lost_damping + lost_friction + lost_contact + lost_corners +
           lost_anchors + lost_scheme + lost_switch - anchor_work;
  }
};

/// Largest |total - initial total| over the largest kinetic energy; 0 for an empty ledger or one
/// without motion.
double closure_error(const std::vector<LedgerEntry>& ledger);

}  // namespace springlod::sim
