#pragma once

#include <array>
#include <vector>

#include "sim/held/anchor.hpp"

namespace springlod::sim {

/// The path of an anchor over time: piecewise cubic in each component of displacement and rotation
/// vector, with the slopes of Fritsch and Butland (1984) at the poses and 0 at both ends. So it
/// passes through the poses, its velocity is continuous, and no component overshoots them.
class RigidPath {
 public:
  explicit RigidPath(const std::vector<AnchorKey>& keys);

  bool is_still() const { return time_.empty(); }

  struct Pose {
    Vec3 move = Vec3::Zero();          ///< [m]
    Mat3 rotation = Mat3::Identity();  ///< [1]
    Vec3 velocity = Vec3::Zero();      ///< of the displacement [m/s]
    Vec3 spin = Vec3::Zero();          ///< angular velocity [rad/s]
  };
  Pose at(double time) const;

 private:
  using Components = std::array<double, 6>;  // displacement [m], rotation vector [rad]

  std::vector<double> time_;  // [s]; empty: it is still
  std::vector<Components> value_;
  std::vector<Components> slope_;  // [1/s]
};

}  // namespace springlod::sim
