#pragma once

#include <vector>

#include "model/mass_spring.hpp"
#include "sim/fast/fast_correction.hpp"
#include "sim/held/anchor_forces.hpp"

namespace springlod::sim {

/// The held nodes of a fast body. Its kicks treat them as all others; the correction of each drift
/// then puts them where they are held (StepNodes). Here the forces of the anchors are found from
/// what the correction changed.
class FastAnchors {
 public:
  /// Everything must outlive this.
  FastAnchors(const MassSpringModel& model, const Vec3& gravity, const HeldNodes& held);

  /// Before a start, with a half kick of the velocities `v` of all nodes [m/s].
  void start(const std::vector<Vec3>& v);
  /// After the kick of a step of length `step` [s], whose end the held nodes have been moved to:
  /// replaces their velocities before and after it by those of their anchors.
  void observe(double step, const std::vector<Vec3>& x, std::vector<Vec3>& v_minus,
               std::vector<Vec3>& v_plus);
  /// After the correction of a drift.
  void book(double step, const FastCorrection& correction, AnchorForces& forces);
  /// Ends steps of this length.
  void end_step(AnchorForces& forces);

  /// Work with the forces at the last observation, over the half step before it [J].
  double half_work() const;
  /// Damping losses at held nodes beyond those by their velocities after the kicks [J].
  double lost_damping() const { return lost_damping_; }

 private:
  struct Node {
    Vec3 before = Vec3::Zero();  // velocity of its anchor over the last step; at a start any [m/s]
    double half_work = 0;        // see half_work() [J]
  };
  /// Force of the anchor [N]; `free`: velocity after the kick, `velocity`: that of the anchor.
  Vec3 force(std::size_t held, double step, const Vec3& free, const Vec3& velocity) const;
  /// Acceleration by the kick [m/s2].
  Vec3 acceleration(std::size_t held, double step, const Vec3& free) const;

  const MassSpringModel* model_;
  Vec3 gravity_;  // [m/s2]
  const HeldNodes* held_;
  std::vector<Node> nodes_;  // by held node
  bool at_start_ = true;     // the next kick is that of a start
  double lost_damping_ = 0;
};

}  // namespace springlod::sim
