#include "sim/study/free_rotation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/QR>

namespace springlod::sim {
namespace {

// Largest angle of one step of the midpoint rule [rad]: its error is of third order, so about 1e-6
// of a rotation.
constexpr double kStepAngle = 0.02;

Mat3 rotation_by(const Vec3& vector) {
  const double angle = vector.norm();
  if (!(angle > 0)) return Mat3::Identity();
  return Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix();
}

}  // namespace

std::vector<Mat3> free_rotation(const MassSpringModel& model, const Throw& start, double end,
                                double rate) {
  const Mat3 inertia = mass_properties(model).inertia;
  const auto solver = inertia.completeOrthogonalDecomposition();
  Mat3 turned = start.rotation;
  const Vec3 momentum = turned * inertia * turned.transpose() * start.spin;
  const auto spin = [&](const Mat3& rotation) -> Vec3 {
    return rotation * solver.solve(rotation.transpose() * momentum);
  };
  const int steps =
      std::max(1, static_cast<int>(std::ceil(start.spin.norm() / (rate * kStepAngle))));
  const double step = 1 / (rate * steps);
  std::vector<Mat3> rotations{turned};
  const auto frames = static_cast<std::size_t>(end * rate);
  while (rotations.size() <= frames) {
    for (int i = 0; i < steps; ++i) {
      const Vec3 middle = spin(rotation_by(spin(turned) * step / 2) * turned);
      turned = rotation_by(middle * step) * turned;
    }
    rotations.push_back(turned);
  }
  return rotations;
}

double rotation_difference(const MassSpringModel& base, const MassSpringModel& level,
                           const Throw& start, double end, double rate) {
  if (start.spin.isZero()) return 0;
  const MassProperties whole = mass_properties(base);
  Mat3 moments = Mat3::Zero();  // [kg m2]
  for (std::uint32_t i = 0; i < base.node_count(); ++i) {
    const Vec3 arm = base.rest[i] - whole.center;
    moments += base.mass[i] * arm * arm.transpose();
  }
  const std::vector<Mat3> wanted = free_rotation(base, start, end, rate);
  const std::vector<Mat3> found = free_rotation(level, start, end, rate);
  double sum = 0;
  for (std::size_t f = 0; f < wanted.size(); ++f) {
    const Mat3 difference = found[f] - wanted[f];
    sum += std::sqrt((difference * moments * difference.transpose()).trace() / whole.mass);
  }
  return sum / static_cast<double>(wanted.size());
}

}  // namespace springlod::sim
