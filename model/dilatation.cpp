#include "model/dilatation.hpp"

#include <string>

#include <fmt/format.h>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/mass_spring.hpp"
#include "model/ranges.hpp"

namespace springlod::inline model {
namespace {

/// Tolerance of validation for the sums at rest [1]: a change of units or a rigid motion rounds.
constexpr double kUnitRounding = 1e-6;

void validate_sizes(const DilatationTerms& terms) {
  if (terms.damping_time.size() != terms.modulus.size() ||
      terms.start.size() != (terms.empty() ? 0 : terms.modulus.size() + 1))
    throw InputError(
        fmt::format("model: every array of its dilatation terms must have {} entries, and the one "
                    "of their starts one more",
                    terms.modulus.size()));
  const std::size_t entries = terms.empty() ? 0 : terms.start.back();
  if (terms.node.size() != entries || terms.gradient.size() != entries)
    throw InputError(fmt::format(
        "model: the nodes and gradients of its dilatation terms must have {} entries", entries));
  if (!terms.empty() && terms.start.front() != 0)
    throw InputError("model: the nodes of its first dilatation term must come first");
}

void validate_term(const MassSpringModel& model, const Components& components, std::uint32_t t) {
  const DilatationTerms& terms = model.dilatation;
  const auto fail = [&](const std::string& rule) {
    throw InputError(fmt::format("model: dilatation term {}: {}", script_number(t), rule));
  };
  const auto require = [&](const char* quantity, double value, const PhysicalRange& range) {
    if (!range.contains(value)) fail(outside(quantity, value, range));
  };
  if (terms.start[t] >= terms.start[t + 1] || terms.start[t + 1] > terms.node.size())
    fail("its nodes must follow those of the term before, at least one");
  require("modulus", std::abs(terms.modulus[t]), range::kDilatation);
  require("damping time", terms.damping_time[t], range::kDampingTime);
  const auto nodes = terms.nodes(t);
  const auto gradients = terms.gradients(t);
  Mat3 unit = Mat3::Zero();
  Vec3 sum = Vec3::Zero();
  double size = 0;
  for (std::size_t e = 0; e < nodes.size(); ++e) {
    if (nodes[e] >= model.node_count()) fail("it refers to a node that does not exist");
    if (e > 0 && nodes[e - 1] >= nodes[e]) fail("its nodes must be sorted, none twice");
    if (components.of_node[nodes[e]] != components.of_node[nodes[0]])
      fail("its nodes must lie in one connected component");
    for (const double each : gradients[e]) require("gradient", each, range::kGradient);
    unit += (model.rest[nodes[e]] - model.rest[nodes[0]]) * gradients[e].transpose();
    sum += gradients[e];
    size += gradients[e].norm();
  }
  if (!((unit - Mat3::Identity()).norm() <= kUnitRounding) || !(sum.norm() <= kUnitRounding * size))
    fail("its deformation gradient at rest must be the unit matrix");
}

}  // namespace

void DilatationTerms::reserve(std::size_t terms, std::size_t nodes_of_all) {
  modulus.reserve(terms);
  damping_time.reserve(terms);
  start.reserve(terms + 1);
  node.reserve(nodes_of_all);
  gradient.reserve(nodes_of_all);
}

void DilatationTerms::add(double term_modulus, double term_damping_time,
                          std::span<const std::uint32_t> nodes, std::span<const Vec3> gradients) {
  if (start.empty()) start.push_back(0);
  modulus.push_back(term_modulus);
  damping_time.push_back(term_damping_time);
  node.insert(node.end(), nodes.begin(), nodes.end());
  gradient.insert(gradient.end(), gradients.begin(), gradients.end());
  start.push_back(static_cast<std::uint32_t>(node.size()));
}

Mat3 mean_gradient(const DilatationTerms& terms, std::uint32_t term, const std::vector<Vec3>& x) {
  const auto nodes = terms.nodes(term);
  const auto gradients = terms.gradients(term);
  Mat3 gradient = Mat3::Zero();
  // Relative to one node, which rounds less far from the origin.
  for (std::size_t e = 1; e < nodes.size(); ++e)
    gradient += (x[nodes[e]] - x[nodes[0]]) * gradients[e].transpose();
  return gradient;
}

VolumeRatio volume_ratio(const Mat3& gradient) {
  VolumeRatio ratio;
  ratio.by_gradient.col(0) = gradient.col(1).cross(gradient.col(2));
  ratio.by_gradient.col(1) = gradient.col(2).cross(gradient.col(0));
  ratio.by_gradient.col(2) = gradient.col(0).cross(gradient.col(1));
  ratio.value = gradient.col(0).dot(ratio.by_gradient.col(0));
  return ratio;
}

double linear_dilatation(const DilatationTerms& terms, std::uint32_t term,
                         const std::vector<Vec3>& u) {
  double strain = 0;
  for (std::uint32_t e = terms.start[term]; e < terms.start[term + 1]; ++e)
    strain += terms.gradient[e].dot(u[terms.node[e]]);
  return strain;
}

double dilatation_energy(const DilatationTerms& terms, const std::vector<Vec3>& x) {
  double energy = 0;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const double ratio = volume_ratio(mean_gradient(terms, t, x)).value;
    const double strain = dilatation(ratio, terms.modulus[t]).strain;
    energy += terms.modulus[t] * strain * strain / 2;
  }
  return energy;
}

DilatationShares dilatation_shares(const MassSpringModel& model) {
  // Squared distance that counts as the middle, over the mean squared distance [1].
  constexpr double kMiddle = 0.01;
  const DilatationTerms& terms = model.dilatation;
  DilatationShares shares{std::vector<double>(model.node_count(), 0),
                          std::vector<double>(model.node_count(), 0)};
  std::vector<double> size(model.node_count(), 0);  // sum of |modulus|
  std::vector<double> weight;
  for (std::uint32_t t = 0; t < terms.count(); ++t) {
    const auto nodes = terms.nodes(t);
    const auto count = static_cast<double>(nodes.size());
    Vec3 middle = Vec3::Zero();
    for (const std::uint32_t node : nodes) middle += model.rest[node] / count;
    weight.clear();
    double spread = 0;
    for (const std::uint32_t node : nodes) {
      weight.push_back((model.rest[node] - middle).squaredNorm());
      spread += weight.back() / count;
    }
    double sum = 0;
    for (double& each : weight) {
      each = 1 / (each + kMiddle * spread);
      sum += each;
    }
    for (std::size_t e = 0; e < nodes.size(); ++e) {
      const double share = terms.modulus[t] * (weight[e] / sum);
      shares.modulus[nodes[e]] += share;
      shares.damping_time[nodes[e]] += std::abs(share) * terms.damping_time[t];
      size[nodes[e]] += std::abs(share);
    }
  }
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    if (size[i] > 0) shares.damping_time[i] /= size[i];
  return shares;
}

void validate_dilatation(const MassSpringModel& model) {
  validate_sizes(model.dilatation);
  if (model.dilatation.empty()) return;
  const Components components = connected_components(model);
  for (std::uint32_t t = 0; t < model.dilatation.count(); ++t) validate_term(model, components, t);
}

}  // namespace springlod::inline model
