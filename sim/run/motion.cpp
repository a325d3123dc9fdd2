#include "sim/run/motion.hpp"

#include <Eigen/QR>

namespace springlod::sim {

Vec3 angular_velocity(const MassSpringModel& model, const State& state) {
  const Vec3 center = center_of_mass(model, state.x);
  Vec3 momentum = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Vec3 arm = state.x[i] - center;
    momentum += model.mass[i] * arm.cross(state.v[i]);
    inertia += model.mass[i] * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  return inertia.completeOrthogonalDecomposition().solve(momentum);
}

}  // namespace springlod::sim
