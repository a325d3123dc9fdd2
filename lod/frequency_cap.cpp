#include "lod/frequency_cap.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "model/spring_rows.hpp"

namespace springlod {
namespace {

constexpr double kPower = 32;

std::vector<Mat3> node_stiffness(const MassSpringModel& model) {
  std::vector<Mat3> held(model.node_count(), Mat3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Vec3 u = spring_direction(model, s);
    const Mat3 k = model.stiffness[s] * u * u.transpose();
    held[model.a[s]] += k;
    held[model.b[s]] += k;
  }
  return held;
}

/// |A| and what it grows by with each part of A along the axes: d|A| = sum_d slope_d
/// (axis_d.dA.axis_d).
struct Norm {
  double value = 0;
  Vec3 slope = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
};

Norm norm_of(const Mat3& a) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(a);
  const double most = solver.eigenvalues()[2];
  if (!(most > 0)) return {};
  const Eigen::Array3d relative = (solver.eigenvalues() / most).cwiseMax(0).array();
  const double sum = relative.pow(kPower).sum();
  const double value = most * std::pow(sum, 1 / kPower);
  return {value, relative.pow(kPower - 1) * (value / (most * sum)), solver.eigenvectors()};
}

double bound_of(const Norm& norm, double mass) {
  return 2 * norm.value / mass;
}

}  // namespace

CapRows cap_rows(const MassSpringModel& model, double tau, double margin) {
  const SpringRows springs(model);
  const std::vector<Mat3> held = node_stiffness(model);
  std::vector<double> excess;
  std::vector<Eigen::Triplet<double>> slopes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Norm norm = norm_of(held[i]);
    const double over = std::log(bound_of(norm, model.mass[i]) / tau);
    if (!(over > -margin)) continue;
    const auto row = static_cast<int>(excess.size());
    excess.push_back(over);
    springs.for_each(i, [&](std::uint32_t, std::uint32_t s) {
      const Vec3 along = norm.axes.transpose() * spring_direction(model, s);
      const double part = norm.slope.dot(along.cwiseAbs2()) / norm.value;
      slopes.emplace_back(row, static_cast<int>(s), model.stiffness[s] * part);
    });
    slopes.emplace_back(row, static_cast<int>(model.spring_count() + i), -1.0);
  }
  CapRows rows;
  rows.excess =
      Eigen::Map<const Eigen::VectorXd>(excess.data(), static_cast<Eigen::Index>(excess.size()));
  rows.slopes.resize(rows.excess.size(),
                     static_cast<Eigen::Index>(model.spring_count()) + model.node_count());
  rows.slopes.setFromTriplets(slopes.begin(), slopes.end());
  return rows;
}

double largest_node_bound(const MassSpringModel& model) {
  const std::vector<Mat3> held = node_stiffness(model);
  double most = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    most = std::max(most, bound_of(norm_of(held[i]), model.mass[i]));
  return most;
}

double squared_excess(const MassSpringModel& model, double tau) {
  const std::vector<Mat3> held = node_stiffness(model);
  double sum = 0;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const double over = std::log(bound_of(norm_of(held[i]), model.mass[i]) / tau);
    if (over > 0) sum += over * over;
  }
  return sum;
}

}  // namespace springlod
