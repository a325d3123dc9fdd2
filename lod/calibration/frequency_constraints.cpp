#include "lod/calibration/frequency_constraints.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Eigenvalues>

#include "elastic/stable_step.hpp"
#include "model/spring_rows.hpp"

namespace springlod::lod {
namespace {

constexpr double kPower = 32;

/// |A| and its gradient along the eigenvectors: d|A| = sum_d gradient_d (axis_d . dA axis_d).
struct Norm {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
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

std::vector<double> node_bounds(const MassSpringModel& model) {
  const std::vector<Mat3> held = elastic::node_stiffness(model);
  std::vector<double> bounds;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    bounds.push_back(bound_of(norm_of(held[i]), model.mass[i]));
  return bounds;
}

}  // namespace

FrequencyConstraints frequency_constraints(const MassSpringModel& model, double tau, double margin,
                                           NodeMasses masses) {
  const bool free_masses = masses == NodeMasses::free;
  const SpringRows springs(model);
  const std::vector<Mat3> held = elastic::node_stiffness(model);
  std::vector<double> values;
  std::vector<Eigen::Triplet<double>> jacobian;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Norm norm = norm_of(held[i]);
    const double value = std::log(bound_of(norm, model.mass[i]) / tau);
    if (!(value > -margin)) continue;
    const auto row = static_cast<int>(values.size());
    values.push_back(value);
    springs.for_each(i, [&](std::uint32_t, std::uint32_t s) {
      const Vec3 along = norm.axes.transpose() * spring_direction(model, s);
      const double derivative = norm.gradient.dot(along.cwiseAbs2()) / norm.value;
      jacobian.emplace_back(row, static_cast<int>(s), model.stiffness[s] * derivative);
    });
    if (free_masses) jacobian.emplace_back(row, static_cast<int>(model.spring_count() + i), -1.0);
  }
  FrequencyConstraints constraints;
  constraints.value =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::Index unknowns =
      model.spring_count() + static_cast<Eigen::Index>(free_masses ? model.node_count() : 0);
  constraints.jacobian.resize(constraints.value.size(), unknowns);
  constraints.jacobian.setFromTriplets(jacobian.begin(), jacobian.end());
  return constraints;
}

double largest_node_bound(const MassSpringModel& model) {
  const std::vector<double> bounds = node_bounds(model);
  return *std::max_element(bounds.begin(), bounds.end());
}

double squared_violation(const MassSpringModel& model, double tau) {
  double sum = 0;
  for (const double bound : node_bounds(model))
    if (bound > tau) sum += std::pow(std::log(bound / tau), 2);
  return sum;
}

}  // namespace springlod::lod
