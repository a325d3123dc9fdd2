#include "lod/calibration/frequency_constraints.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "elastic/stable_step.hpp"
#include "model/spring_rows.hpp"
#include "model/terms_of_nodes.hpp"

namespace springlod::lod {
namespace {

/// |A| = tr(A^32)^(1/32), by repeated squaring of A over its trace.
class SchattenNorm {
 public:
  explicit SchattenNorm(const Mat3& a) : scale_(a.trace()) {
    if (!(scale_ > 0)) return;
    powers_[0] = a / scale_;
    for (std::size_t i = 1; i < powers_.size(); ++i)
      powers_[i].noalias() = powers_[i - 1] * powers_[i - 1];
    trace_ = powers_.back().squaredNorm();
    value_ = scale_ * std::pow(trace_, 1 / kPower);
  }
  double value() const { return value_; }
  /// Derivative of ln |A| by A: d ln |A| = sum of its entries times those of dA. |A| is not 0.
  Mat3 log_gradient() const {
    Mat3 product = powers_[0];  // (A / trace)^31 in the end
    for (std::size_t i = 1; i < powers_.size(); ++i) product = product * powers_[i];
    return product / (scale_ * trace_);
  }

 private:
  static constexpr double kPower = 32;

  double scale_, trace_ = 0, value_ = 0;
  std::array<Mat3, 5> powers_;  // 1, 2, 4, 8, 16
};

double bound_of(const SchattenNorm& norm, double mass) {
  return 2 * norm.value() / mass;
}

std::vector<double> node_bounds(const MassSpringModel& model) {
  const std::vector<Mat3> held = elastic::bounding_node_stiffness(model);
  std::vector<double> bounds;
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    bounds.push_back(bound_of(SchattenNorm(held[i]), model.mass[i]));
  return bounds;
}

}  // namespace

FrequencyConstraints frequency_constraints(const MassSpringModel& model, double tau, double margin,
                                           NodeMasses masses) {
  const bool free_masses = masses == NodeMasses::free;
  const SpringRows springs(model);
  const std::vector<Mat3> held = elastic::bounding_node_stiffness(model);
  const DilatationTerms& terms = model.dilatation;
  const TermsOfNodes terms_of_nodes(model);
  const auto moduli = static_cast<int>(model.spring_count() + terms.count());
  std::vector<double> values;
  std::vector<Eigen::Triplet<double>> jacobian;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const SchattenNorm norm(held[i]);
    const double value = std::log(bound_of(norm, model.mass[i]) / tau);
    if (!(value > -margin)) continue;
    const auto row = static_cast<int>(values.size());
    values.push_back(value);
    const Mat3 gradient = norm.log_gradient();
    springs.for_each(i, [&](std::uint32_t, std::uint32_t s) {
      const Vec3 u = spring_direction(model, s);
      jacobian.emplace_back(row, static_cast<int>(s), model.stiffness[s] * u.dot(gradient * u));
    });
    for (const auto& [t, entry] : terms_of_nodes.of(i)) {
      if (!(terms.modulus[t] > 0)) continue;
      const Mat3 share =
          elastic::bounding_share(elastic::sum_of_norms(terms.gradients(t)), terms.gradient[entry]);
      jacobian.emplace_back(row, static_cast<int>(model.spring_count() + t),
                            gradient.cwiseProduct(terms.modulus[t] * share).sum());
    }
    if (free_masses) jacobian.emplace_back(row, moduli + static_cast<int>(i), -1.0);
  }
  FrequencyConstraints constraints;
  constraints.value =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  const Eigen::Index unknowns =
      moduli + static_cast<Eigen::Index>(free_masses ? model.node_count() : 0);
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
