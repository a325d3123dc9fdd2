#include "lod/calibration/second_moments.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "lod/merging/merge_dilatation.hpp"

namespace springlod::lod {
namespace {

/// Moments below this fraction of the largest count as 0.
constexpr double kFlat = 1e-9;

/// Moments of one connected component.
struct Moments {
  double mass = 0;
  Vec3 center = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};

/// `part` is the component of each node.
std::vector<Moments> moments_of(const MassSpringModel& model,
                                const std::vector<std::uint32_t>& part, std::uint32_t count) {
  std::vector<Moments> moments(count);
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    moments[part[i]].mass += model.mass[i];
    moments[part[i]].center += model.mass[i] * model.rest[i];
  }
  for (Moments& each : moments) each.center /= each.mass;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Moments& of_part = moments[part[i]];
    const Vec3 r = model.rest[i] - of_part.center;
    of_part.second += model.mass[i] * r * r.transpose();
  }
  return moments;
}

/// A^power of a positive semidefinite matrix; 0 on its null space.
Mat3 power_of(const Mat3& a, double power) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(a);
  Vec3 values = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (solver.eigenvalues()[d] > kFlat * solver.eigenvalues()[2])
      values[d] = std::pow(solver.eigenvalues()[d], power);
  return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

}  // namespace

Mat3 second_moments(const MassSpringModel& model) {
  return moments_of(model, std::vector<std::uint32_t>(model.node_count(), 0), 1).front().second;
}

void restore_second_moments(const MassSpringModel& base, const Groups& of_base,
                            MassSpringModel& level) {
  const Components parts = connected_components(level);
  std::vector<std::uint32_t> part_of_base;
  for (const std::uint32_t group : of_base.of) part_of_base.push_back(parts.of_node[group]);
  const std::vector<Moments> wanted = moments_of(base, part_of_base, parts.count);
  const std::vector<Moments> found = moments_of(level, parts.of_node, parts.count);
  std::vector<Mat3> map;
  for (std::uint32_t p = 0; p < parts.count; ++p) {
    const Mat3 root = power_of(wanted[p].second, 0.5);
    map.emplace_back(root * power_of(root * found[p].second * root, -0.5) * root);
  }
  for (std::uint32_t i = 0; i < level.node_count(); ++i) {
    const std::uint32_t p = parts.of_node[i];
    level.rest[i] = wanted[p].center + map[p] * (level.rest[i] - found[p].center);
  }
  for (std::uint32_t s = 0; s < level.spring_count(); ++s) {
    const double length = (level.rest[level.b[s]] - level.rest[level.a[s]]).norm();
    const double factor = level.rest_length[s] / length;
    level.stiffness[s] *= factor;
    level.damping[s] *= factor;
    level.rest_length[s] = length;
  }
  settle_corners(level.corners, level.rest);
  // Their gradients depend on the positions.
  level.dilatation = merge_dilatation(base, of_base, level);
}

}  // namespace springlod::lod
