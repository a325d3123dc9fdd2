#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "model/vec.hpp"

namespace springlod::sim {

class FastBody;

/// The velocities velocity + spin x x of a rigid body, in the coordinates of a FastBody.
struct RigidMotion {
  Vec3 velocity = Vec3::Zero();  ///< [m/s]
  Vec3 spin = Vec3::Zero();      ///< [rad/s]

  /// [m/s]
  Vec3 at(const Vec3& x) const { return velocity + spin.cross(x); }
};

/// Fits a rigid motion to a few nodes that are spread over a body: enough to tell how it deforms.
class RigidFit {
 public:
  explicit RigidFit(std::uint32_t node_count);
  /// The motion with the mean velocity of these nodes, and the spin that fits best.
  RigidMotion fit(const FastBody& body) const;

 private:
  std::vector<std::uint32_t> nodes_;
};

}  // namespace springlod::sim
