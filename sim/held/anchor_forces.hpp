#pragma once

#include <vector>

#include "sim/held/held_nodes.hpp"

namespace springlod::sim {

/// What an anchor has done to the body since the start of a run.
struct AnchorSum {
  Vec3 impulse = Vec3::Zero();  ///< time integral of its force on the body [N s]
  Vec3 twist = Vec3::Zero();    ///< the same of its torque about its pivot [N m s]
  double work = 0;              ///< [J]
};

/// Sums of the forces that anchors need to hold their nodes, by anchor.
class AnchorForces {
 public:
  explicit AnchorForces(std::size_t anchors) : sums_(anchors) {}

  /// Adds an impulse of its anchor on one of the held nodes, which have been moved to the end of
  /// the step, and its work [J].
  void add(const HeldNodes& held, std::size_t node, const Vec3& impulse, double work) {
    const std::size_t anchor = held.anchor(node);
    AnchorSum& sum = sums_[anchor];
    sum.impulse += impulse;
    sum.twist += (held.at()[node] - held.pivot(anchor)).cross(impulse);
    sum.work += work;
  }

  const std::vector<AnchorSum>& sums() const { return sums_; }
  double work() const {
    double work = 0;
    for (const AnchorSum& sum : sums_) work += sum.work;
    return work;
  }

 private:
  std::vector<AnchorSum> sums_;
};

}  // namespace springlod::sim
