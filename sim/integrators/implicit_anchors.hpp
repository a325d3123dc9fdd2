#pragma once

#include <vector>

#include "sim/held/anchor_springs.hpp"

namespace springlod::sim {

/// The springs of anchors in an implicit step of length dt. With e and e_n the distances of a node
/// from its place at the end and the start of the step, k e + c (e - e_n)/dt is the force of a
/// spring without damper, of stiffness k + c/dt, from the place p + c/dt e_n / (k + c/dt): see
/// ImplicitSprings.
class ImplicitAnchors {
 public:
  /// Springs must outlive this.
  ImplicitAnchors(const AnchorSprings& springs, double step);

  /// Begins a step from the positions `x` of all nodes. The places are where they are at its end.
  void begin_step(const std::vector<Vec3>& x);

  std::uint32_t count() const { return springs_->count(); }
  std::uint32_t node(std::size_t spring) const { return springs_->node(spring); }
  double stiffness(std::size_t spring) const { return stiffness_[spring]; }     ///< [N/m]
  const Vec3& place(std::size_t spring) const { return steps_[spring].place; }  ///< [m]
  /// Sum of k' |x - p'|^2 / 2 [J].
  double energy(const std::vector<Vec3>& x) const;

  /// Ends the step at the positions `x`. Returns the energy that the dampers took [J].
  double end_step(const std::vector<Vec3>& x);
  /// Adds what the springs did in the step.
  void book(AnchorForces& forces) const;
  /// Stored in the springs at the end of the step, where the nodes are at `x` [J].
  double stored(const std::vector<Vec3>& x) const;

 private:
  struct Step {
    Vec3 before = Vec3::Zero();  // place of the anchor at the start [m]
    Vec3 from = Vec3::Zero();    // e_n [m]
    Vec3 place = Vec3::Zero();   // p' [m]
    Vec3 force = Vec3::Zero();   // [N]
  };

  const AnchorSprings* springs_;
  double step_;  // [s]
  std::vector<double> stiffness_;
  std::vector<Step> steps_;  // by spring
  std::vector<Vec3> last_places_;
};

}  // namespace springlod::sim
