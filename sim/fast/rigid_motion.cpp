#include "sim/fast/rigid_motion.hpp"

#include <algorithm>

#include <Eigen/Dense>

#include "sim/fast/fast_body.hpp"

namespace springlod::sim {
namespace {

// With so many nodes, the error of the fit adds about a fifth to the velocities of a body that
// vibrates. [nodes]
constexpr std::uint32_t kNodes = 64;

}  // namespace

// Multiples of the golden section are spread evenly, and hit no lines or planes of a lattice.
RigidFit::RigidFit(std::uint32_t node_count) {
  constexpr std::uint64_t kGolden = 2'654'435'769;  // of 2^32
  for (std::uint64_t i = 0; i < std::min(node_count, kNodes); ++i) {
    const std::uint64_t fraction = (i * kGolden) & 0xFFFFFFFFU;
    const std::uint64_t node = node_count <= kNodes ? i : (fraction * node_count) >> 32U;
    nodes_.push_back(static_cast<std::uint32_t>(node));
  }
}

RigidMotion RigidFit::fit(const FastBody& body) const {
  std::vector<NodeMotion> motions(nodes_.size());
  body.get_motions(nodes_, MovingFrame(), motions);
  Vec3 center = Vec3::Zero();
  Vec3 velocity = Vec3::Zero();
  for (const NodeMotion& motion : motions) {
    center += motion.x;
    velocity += motion.v;
  }
  center /= static_cast<double>(motions.size());
  velocity /= static_cast<double>(motions.size());
  Vec3 momentum = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  for (const NodeMotion& motion : motions) {
    const Vec3 arm = motion.x - center;
    momentum += arm.cross(motion.v - velocity);
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
  }
  const Vec3 spin = inertia.completeOrthogonalDecomposition().solve(momentum);
  return {velocity - spin.cross(center), spin};
}

}  // namespace springlod::sim
