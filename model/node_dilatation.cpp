#include "model/node_dilatation.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "model/spring_rows.hpp"

namespace springlod::inline model {
namespace {

/// Neighbours of a node in its term, if their A is even enough. All of them, some 16 in a merged
/// level, would make a step a third longer, and fitted levels no more accurate.
constexpr std::size_t kNearest = 11;
/// Least eigenvalue of A over its largest [1] for the nearest neighbours, and for more of them:
/// some 0.3 at the surface of a lattice, 1 inside.
constexpr double kEven = 0.2, kFlat = 0.08;

/// Mean and A of some nodes.
struct Spread {
  Vec3 mean = Vec3::Zero();
  Mat3 squares = Mat3::Zero();

  Spread(const std::vector<Vec3>& rest, const std::vector<std::uint32_t>& nodes) {
    for (const std::uint32_t node : nodes) mean += rest[node] / static_cast<double>(nodes.size());
    for (const std::uint32_t node : nodes)
      squares += (rest[node] - mean) * (rest[node] - mean).transpose();
  }
  /// Least eigenvalue of A over its largest; 0 for a single node.
  double evenness() const {
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(squares, Eigen::EigenvaluesOnly);
    const double largest = axes.eigenvalues()[2];
    return largest > 0 ? axes.eigenvalues()[0] / largest : 0;
  }
};

/// The node and the nearest of its neighbours, ascending.
std::vector<std::uint32_t> nearest_nodes(const MassSpringModel& model, const SpringRows& rows,
                                         std::uint32_t i) {
  std::vector<std::pair<double, std::uint32_t>> by_distance;
  rows.for_each(i, [&](std::uint32_t other, std::uint32_t) {
    by_distance.emplace_back((model.rest[other] - model.rest[i]).squaredNorm(), other);
  });
  std::sort(by_distance.begin(), by_distance.end());
  if (by_distance.size() > kNearest) by_distance.resize(kNearest);
  std::vector<std::uint32_t> nodes{i};
  for (const auto& [distance, node] : by_distance) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// Adds the neighbours of the nodes.
void add_neighbours(const SpringRows& rows, std::vector<std::uint32_t>& nodes) {
  const std::vector<std::uint32_t> before = nodes;
  for (const std::uint32_t node : before)
    rows.for_each(node, [&](std::uint32_t other, std::uint32_t) { nodes.push_back(other); });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

/// The nodes of the term of node i; none if they lie nearly in a plane.
std::vector<std::uint32_t> term_nodes(const MassSpringModel& model, const SpringRows& rows,
                                      std::uint32_t i) {
  std::vector<std::uint32_t> nodes = nearest_nodes(model, rows, i);
  if (Spread(model.rest, nodes).evenness() > kEven) return nodes;
  nodes = {i};
  constexpr int kRings = 2;
  for (int ring = 0; ring < kRings; ++ring) {
    add_neighbours(rows, nodes);
    if (Spread(model.rest, nodes).evenness() > kFlat) return nodes;
  }
  return {};
}

}  // namespace

DilatationTerms node_terms(const MassSpringModel& model,
                           const std::vector<NodeDilatation>& of_nodes) {
  assert(of_nodes.size() == model.rest.size());
  const SpringRows rows(model);
  DilatationTerms terms;
  std::vector<Vec3> gradients;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    if (of_nodes[i].modulus == 0) continue;
    const std::vector<std::uint32_t> nodes = term_nodes(model, rows, i);
    if (nodes.empty()) continue;
    const Spread spread(model.rest, nodes);
    const Mat3 inverse = spread.squares.inverse();
    gradients.clear();
    for (const std::uint32_t node : nodes)
      gradients.emplace_back(inverse * (model.rest[node] - spread.mean));
    terms.add(of_nodes[i].modulus, of_nodes[i].damping_time, nodes, gradients);
  }
  return terms;
}

DilatationTerms material_terms(const MassSpringModel& model, const std::vector<double>& factors) {
  std::vector<NodeDilatation> of_nodes;
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    const Material& material = model.materials[model.material[i]];
    const double factor = factors.empty() ? 1 : factors[model.material[i]];
    of_nodes.push_back({factor * dilatation_modulus(material) * model.volume[i], material.damping});
  }
  return node_terms(model, of_nodes);
}

}  // namespace springlod::inline model
