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
  explicit AnchorForces(const HeldNodes& held) : held_(&held), sums_(held.anchor_count()) {}

  /// Adds an impulse of the anchor on a held node, which has been moved to the end of the step, and
  /// its work [J].
  void add(std::size_t held, const Vec3& impulse, double work) {
    const std::size_t anchor = held_->anchor(held);
    AnchorSum& sum = sums_[anchor];
    sum.impulse += impulse;
    sum.twist += (held_->at()[held] - held_->pivot(anchor)).cross(impulse);
    sum.work += work;
  }

  const std::vector<AnchorSum>& sums() const { return sums_; }
  double work() const {
    double work = 0;
    for (const AnchorSum& sum : sums_) work += sum.work;
    return work;
  }

 private:
  const HeldNodes* held_;
  std::vector<AnchorSum> sums_;
};

}  // namespace springlod::sim
