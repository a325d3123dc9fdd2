#include "elastic/stable_step.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Spectra/SymEigsSolver.h>
#include <fmt/format.h>

#include "base/error.hpp"
#include "elastic/solver/random_block.hpp"

namespace springlod::elastic {
namespace {

/// Up to this many unknowns a dense eigenvalue solver is faster than Lanczos and always converges.
constexpr Eigen::Index kDenseUnknowns = 120;
/// Size of the Krylov space. The upper end of a lattice's spectrum is dense; still, on 100k nodes
/// larger spaces cost more in orthogonalization than they save in products (16: 1.3 s, 40: 2.9 s).
constexpr Eigen::Index kKrylovVectors = 16;
constexpr Eigen::Index kMaxRestarts = 200;
/// Residual / eigenvalue at which Lanczos stops. The residual is added to the result, so the
/// relative error of the eigenvalue is at most this, and that of the frequency half of it.
constexpr double kResidualTolerance = 1e-4;

/// Whether each node is held.
std::vector<bool> marked(std::uint32_t node_count, std::span<const std::uint32_t> held) {
  std::vector<bool> is_held(node_count, false);
  for (const std::uint32_t node : held) is_held[node] = true;
  return is_held;
}

/// The operator x -> M^-1/2 K M^-1/2 x in the form that Spectra needs. Held nodes count as infinite
/// masses, which adds zero eigenvalues to those of the system without them.
class MassWeightedStiffness {
 public:
  using Scalar = double;

  MassWeightedStiffness(const MassSpringModel& model, const std::vector<bool>& is_held)
      : node_count_(model.node_count()), a_(model.a), b_(model.b), terms_(model.dilatation) {
    std::vector<double> weight(node_count_);
    for (std::uint32_t i = 0; i < node_count_; ++i)
      weight[i] = is_held[i] ? 0 : 1 / std::sqrt(model.mass[i]);
    end_a_.reserve(a_.size());
    end_b_.reserve(a_.size());
    for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
      const Vec3 row = std::sqrt(model.stiffness[s]) * spring_direction(model, s);
      end_a_.emplace_back(weight[a_[s]] * row);
      end_b_.emplace_back(weight[b_[s]] * row);
    }
    for (std::size_t e = 0; e < terms_.node.size(); ++e)
      gradient_.emplace_back(weight[terms_.node[e]] * terms_.gradient[e]);
  }

  Eigen::Index rows() const { return 3 * static_cast<Eigen::Index>(node_count_); }
  Eigen::Index cols() const { return rows(); }

  void perform_op(const double* in, double* out) const {
    const Eigen::Map<const Eigen::Matrix3Xd> x(in, 3, rows() / 3);
    Eigen::Map<Eigen::Matrix3Xd> y(out, 3, rows() / 3);
    y.setZero();
    for (std::size_t s = 0; s < a_.size(); ++s) {
      const double stretch = end_a_[s].dot(x.col(a_[s])) - end_b_[s].dot(x.col(b_[s]));
      y.col(a_[s]) += stretch * end_a_[s];
      y.col(b_[s]) -= stretch * end_b_[s];
    }
    for (std::uint32_t t = 0; t < terms_.count(); ++t) add_term(t, x, y);
  }

 private:
  void add_term(std::uint32_t t, const Eigen::Map<const Eigen::Matrix3Xd>& x,
                Eigen::Map<Eigen::Matrix3Xd>& y) const {
    double strain = 0;
    for (std::uint32_t e = terms_.start[t]; e < terms_.start[t + 1]; ++e)
      strain += gradient_[e].dot(x.col(terms_.node[e]));
    const double stress = terms_.modulus[t] * strain;
    for (std::uint32_t e = terms_.start[t]; e < terms_.start[t + 1]; ++e)
      y.col(terms_.node[e]) += stress * gradient_[e];
  }

  std::uint32_t node_count_;
  const std::vector<std::uint32_t>& a_;
  const std::vector<std::uint32_t>& b_;
  const DilatationTerms& terms_;
  std::vector<Vec3> end_a_, end_b_;  // sqrt(k/m) u at either end
  std::vector<Vec3> gradient_;       // b / sqrt(m) of the terms
};

double largest_eigenvalue_dense(const MassWeightedStiffness& op) {
  Eigen::MatrixXd matrix(op.rows(), op.rows());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(op.rows());
  for (Eigen::Index i = 0; i < op.rows(); ++i) {
    unit[i] = 1;
    op.perform_op(unit.data(), matrix.col(i).data());
    unit[i] = 0;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix, Eigen::EigenvaluesOnly)
      .eigenvalues()
      .maxCoeff();
}

/// Ritz value plus its residual; infinite if Lanczos did not converge.
double largest_eigenvalue_lanczos(const MassWeightedStiffness& op, std::uint64_t seed) {
  MassWeightedStiffness copy = op;  // Spectra takes a mutable reference
  Spectra::SymEigsSolver<MassWeightedStiffness> solver(copy, 1, kKrylovVectors);
  solver.init(random_block(op.rows(), 1, seed).data());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (solver.compute(Spectra::SortRule::LargestAlge, kMaxRestarts, kResidualTolerance) < 1)
    return kInfinity;
  const double ritz = solver.eigenvalues()[0];
  const Eigen::VectorXd v = solver.eigenvectors(1).col(0);
  Eigen::VectorXd product(op.rows());
  op.perform_op(v.data(), product.data());
  return ritz + (product - ritz * v).norm() / v.norm();
}

/// A_i of each node, from the stiffness of each spring between its ends [N/m].
template <class StiffnessOf>
std::vector<Mat3> sum_at_nodes(const MassSpringModel& model, const StiffnessOf& stiffness_of) {
  std::vector<Mat3> sums(model.node_count(), Mat3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const Mat3 k = stiffness_of(s);
    sums[model.a[s]] += k;
    sums[model.b[s]] += k;
  }
  return sums;
}

/// Stiffness of a spring between its ends in the state x, along it and across [N/m].
Mat3 spring_stiffness_at(const MassSpringModel& model, std::uint32_t s,
                         const std::vector<Vec3>& x) {
  const Vec3 along = x[model.b[s]] - x[model.a[s]];
  const double length = along.norm();
  if (!(length > 0)) return Mat3::Zero();  // the direction is undefined
  const Mat3 lengthwise = along * along.transpose() / (length * length);
  const double across = std::max(0.0, 1 - model.rest_length[s] / length);
  return model.stiffness[s] * (lengthwise + across * (Mat3::Identity() - lengthwise));
}

/// Adds to A_i what dilatation terms add in the state x. The second derivative of T eps^2 / 2 has a
/// part T (d eps)^2, bounded as at rest, and one by the curvature of J, a quadratic form of dF
/// whose eigenvalues are at most twice the norm of F. Terms for which `wanted` is false are left
/// out.
template <class Wanted>
void add_terms_at(const DilatationTerms& terms, const std::vector<Vec3>& x, const Wanted& wanted,
                  std::vector<Mat3>& stiffness) {
  std::vector<Vec3> by_node;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    if (!wanted(t)) continue;
    const double modulus = terms.modulus[t];
    const Mat3 gradient = mean_gradient(terms, t, x);
    const VolumeRatio ratio = volume_ratio(gradient);
    const Dilatation eps = dilatation(ratio.value, modulus);
    by_node.clear();
    for (const Vec3& b : terms.gradients(t))
      by_node.emplace_back(eps.slope * (ratio.by_gradient * b));
    const double sum = sum_of_norms(by_node);
    const double bent = std::abs(modulus * eps.strain * eps.slope) * gradient.norm() *
                        sum_of_norms(terms.gradients(t));
    const auto nodes = terms.nodes(t);
    for (std::size_t e = 0; e < nodes.size(); ++e) {
      if (modulus > 0) stiffness[nodes[e]] += modulus * bounding_share(sum, by_node[e]);
      stiffness[nodes[e]] += bent * terms.gradients(t)[e].norm() * Mat3::Identity();
    }
  }
}

/// sum_j k_ij u u^T of each node.
std::vector<Mat3> spring_sums(const MassSpringModel& model) {
  return sum_at_nodes(model, [&](std::uint32_t s) -> Mat3 {
    const Vec3 u = spring_direction(model, s);
    return model.stiffness[s] * u * u.transpose();
  });
}

/// omega^2 <= max_i 2 lambda_max(A_i) / m_i, for (x_i - x_j)^2 <= 2 x_i^2 + 2 x_j^2, over the nodes
/// that are not held.
double squared_bound(const MassSpringModel& model, const std::vector<bool>& is_held) {
  const std::vector<Mat3> stiffness = bounding_node_stiffness(model);
  double bound = 0;
  for (std::size_t i = 0; i < stiffness.size(); ++i) {
    if (is_held[i]) continue;
    const double top = Eigen::SelfAdjointEigenSolver<Mat3>(stiffness[i], Eigen::EigenvaluesOnly)
                           .eigenvalues()
                           .maxCoeff();
    bound = std::max(bound, 2 * top / model.mass[i]);
  }
  return bound;
}

/// q + 2p: see node_frequency_bounds.
double eigenvalue_bound(const Mat3& symmetric) {
  const double mean = symmetric.trace() / 3;
  const double spread = (symmetric - mean * Mat3::Identity()).squaredNorm();
  return mean + 2 * std::sqrt(spread / 6);
}

}  // namespace

double largest_frequency(const MassSpringModel& model, std::uint64_t seed,
                         std::span<const std::uint32_t> held) {
  const std::vector<bool> is_held = marked(model.node_count(), held);
  const MassWeightedStiffness op(model, is_held);
  const double bound = squared_bound(model, is_held);
  if (bound == 0) return 0;
  const double squared = op.rows() <= kDenseUnknowns ? largest_eigenvalue_dense(op)
                                                     : largest_eigenvalue_lanczos(op, seed);
  return std::sqrt(std::min(squared, bound));
}

double frequency_bound(const MassSpringModel& model) {
  return std::sqrt(squared_bound(model, marked(model.node_count(), {})));
}

std::vector<Mat3> node_stiffness(const MassSpringModel& model) {
  std::vector<Mat3> stiffness = spring_sums(model);
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t)
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      stiffness[terms.node[e]] +=
          terms.modulus[t] * terms.gradient[e] * terms.gradient[e].transpose();
  return stiffness;
}

std::vector<Mat3> bounding_node_stiffness(const MassSpringModel& model) {
  std::vector<Mat3> stiffness = spring_sums(model);
  const DilatationTerms& terms = model.dilatation;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    if (!(terms.modulus[t] > 0)) continue;
    const double sum = sum_of_norms(terms.gradients(t));
    for (std::uint32_t e = terms.start[t]; e < terms.start[t + 1]; ++e)
      stiffness[terms.node[e]] += terms.modulus[t] * bounding_share(sum, terms.gradient[e]);
  }
  return stiffness;
}

Mat3 bounding_share(double sum_of_norms, const Vec3& gradient) {
  const double size = gradient.norm();
  if (!(size > 0)) return Mat3::Zero();
  return sum_of_norms / (2 * size) * gradient * gradient.transpose();
}

double sum_of_norms(std::span<const Vec3> gradients) {
  double sum = 0;
  for (const Vec3& gradient : gradients) sum += gradient.norm();
  return sum;
}

std::vector<double> node_frequency_bounds(const MassSpringModel& model,
                                          const std::vector<Vec3>& x) {
  std::vector<Mat3> stiffness = sum_at_nodes(
      model, [&](std::uint32_t s) -> Mat3 { return spring_stiffness_at(model, s, x); });
  add_terms_at(
      model.dilatation, x, [](std::uint32_t) { return true; }, stiffness);
  std::vector<double> bounds(stiffness.size());
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    bounds[i] = 2 * eigenvalue_bound(stiffness[i]) / model.mass[i];
  return bounds;
}

std::vector<double> strained_frequency_bounds(const MassSpringModel& model,
                                              const std::vector<Vec3>& x, double strain) {
  std::vector<std::uint8_t> strained(model.node_count(), 0);
  const double least = (1 - strain) * (1 - strain);
  const double most = (1 + strain) * (1 + strain);
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double square = (x[model.b[s]] - x[model.a[s]]).squaredNorm() /
                          (model.rest_length[s] * model.rest_length[s]);
    if (!(square >= least && square <= most)) strained[model.a[s]] = strained[model.b[s]] = 1;
  }
  std::vector<Mat3> stiffness(model.node_count(), Mat3::Zero());
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    if ((strained[model.a[s]] | strained[model.b[s]]) == 0) continue;
    const Mat3 k = spring_stiffness_at(model, s, x);
    stiffness[model.a[s]] += k;
    stiffness[model.b[s]] += k;
  }
  const auto near_strained = [&](std::uint32_t t) {
    const auto nodes = model.dilatation.nodes(t);
    return std::any_of(nodes.begin(), nodes.end(),
                       [&](std::uint32_t node) { return strained[node] != 0; });
  };
  add_terms_at(model.dilatation, x, near_strained, stiffness);
  std::vector<double> bounds(model.node_count(), 0);
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    if (strained[i] != 0) bounds[i] = 2 * eigenvalue_bound(stiffness[i]) / model.mass[i];
  return bounds;
}

double largest_damping_time(const MassSpringModel& model) {
  double longest = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s)
    longest = std::max(longest, model.damping[s] / model.stiffness[s]);
  for (const double time : model.dilatation.damping_time) longest = std::max(longest, time);
  return longest;
}

double stable_step(double omega_max, double damping_time) {
  if (omega_max == 0) return std::numeric_limits<double>::infinity();
  // -beta + sqrt(beta^2 + q) without the cancellation.
  const double q = 4 / (omega_max * omega_max);
  return q / (damping_time + std::sqrt(damping_time * damping_time + q));
}

double stable_step(const MassSpringModel& model) {
  return stable_step(largest_frequency(model), largest_damping_time(model));
}

}  // namespace springlod::elastic
