#include "model/binding.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <nanoflann.hpp>

#include "base/error.hpp"
#include "base/script_number.hpp"
#include "model/mass_spring.hpp"
#include "model/spring_rows.hpp"

namespace springlod::inline model {
namespace {

/// A point closer to a node than this fraction of the candidates' radius coincides with it.
constexpr double kOnNode = 1e-9;
/// A point may lie this many (weighted) standard deviations of the candidates outside before it is
/// projected back. With 10, a point one spacing outside a lattice is kept (it has at most 9), and
/// the weights of nearly flat sets stay bounded.
constexpr double kFarthestDeviations = 10;
/// A variance below this fraction of the largest is rounding: the nodes do not span that direction.
constexpr double kFlatVariance = 1e-12;
/// If the candidates are thinner than this fraction of their width, one outside their plane is
/// added.
constexpr double kThin = 0.05;
/// Least distance of that one from the plane, as a fraction of the width.
constexpr double kOffPlane = 0.2;

/// Largest weight of an entry [1]. Those of append_weights are at most 1 + sqrt(3) *
/// kFarthestDeviations, which is 18.4.
constexpr double kLargestWeight = 100;
/// Rounding of the sum of the weights of a point [1].
constexpr double kWeightRounding = 1e-6;

struct Candidate {
  double distance2;
  std::uint32_t node;
  bool operator<(const Candidate& other) const {
    return distance2 != other.distance2 ? distance2 < other.distance2 : node < other.node;
  }
};

std::vector<Candidate> by_distance(const Vec3& point, const MassSpringModel& model,
                                   const std::vector<std::uint32_t>& nodes) {
  std::vector<Candidate> candidates;
  candidates.reserve(nodes.size());
  for (const std::uint32_t node : nodes)
    candidates.push_back({(model.rest[node] - point).squaredNorm(), node});
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(
      std::unique(candidates.begin(), candidates.end(),
                  [](const Candidate& p, const Candidate& q) { return p.node == q.node; }),
      candidates.end());
  return candidates;
}

/// Kernel of the distance over the candidates' radius. It is infinite at 0, so the weights tend to
/// those of a node as the point approaches it. It decreases slowly at large distances, so a point
/// outside depends on more than the outermost layer.
double kernel(double distance2, double reach2) {
  const double rho2 = distance2 / reach2;
  return std::exp(-2 * rho2) / rho2;
}

/// Step g from the kernel-weighted centre to the point, in the metric of the variance. The weights
/// are phi_j (1 + (X_j - centre) . g).
Vec3 metric_step(const Mat3& variance, const Vec3& offset) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(variance);
  Vec3 step = Vec3::Zero();
  for (int d = 0; d < 3; ++d) {
    const double lambda = eigen.eigenvalues()[d];
    if (lambda <= kFlatVariance * eigen.eigenvalues()[2]) continue;
    const double limit = kFarthestDeviations * std::sqrt(lambda);
    const Vec3 axis = eigen.eigenvectors().col(d);
    step += std::clamp(axis.dot(offset), -limit, limit) / lambda * axis;
  }
  return step;
}

void end_row(Binding& binding) {
  binding.start.push_back(static_cast<std::uint32_t>(binding.node.size()));
}

void append_weights(Binding& binding, const Vec3& point, const MassSpringModel& model,
                    const std::vector<Candidate>& candidates) {
  if (binding.start.empty()) binding.start.push_back(0);
  const double reach2 = candidates.back().distance2;
  if (candidates.size() == 1 || candidates[0].distance2 <= kOnNode * kOnNode * reach2) {
    binding.node.push_back(candidates[0].node);
    binding.weight.push_back(1);
    return end_row(binding);
  }

  std::vector<double> phi(candidates.size());
  double sum = 0;
  for (std::size_t j = 0; j < phi.size(); ++j)
    sum += phi[j] = kernel(candidates[j].distance2, reach2);
  Vec3 centre = Vec3::Zero();  // relative to the point, against cancellation
  for (std::size_t j = 0; j < phi.size(); ++j)
    centre += (phi[j] /= sum) * (model.rest[candidates[j].node] - point);
  Mat3 variance = Mat3::Zero();
  for (std::size_t j = 0; j < phi.size(); ++j) {
    const Vec3 d = model.rest[candidates[j].node] - point - centre;
    variance += phi[j] * d * d.transpose();
  }

  const Vec3 step = metric_step(variance, -centre);
  for (std::size_t j = 0; j < phi.size(); ++j) {
    const Vec3 d = model.rest[candidates[j].node] - point - centre;
    binding.node.push_back(candidates[j].node);
    binding.weight.push_back(phi[j] * (1 + d.dot(step)));
  }
  end_row(binding);
}

/// The first `count` candidates. If these lie in a plane or a line and later ones do not, the
/// nearest of the later ones replace the farthest of the first.
std::vector<Candidate> choose(const std::vector<Candidate>& candidates, std::size_t count,
                              const MassSpringModel& model) {
  if (candidates.size() <= count) return candidates;
  std::vector<Candidate> chosen(candidates.begin(),
                                candidates.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t round = 0; round < 2; ++round) {  // from a line to a plane to the full space
    Vec3 mean = Vec3::Zero();
    for (const Candidate& c : chosen) mean += model.rest[c.node] / static_cast<double>(count);
    Mat3 variance = Mat3::Zero();
    for (const Candidate& c : chosen) {
      const Vec3 d = model.rest[c.node] - mean;
      variance += d * d.transpose() / static_cast<double>(count);
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(variance);
    const double width = std::sqrt(eigen.eigenvalues()[2]);
    if (eigen.eigenvalues()[0] > kThin * kThin * width * width) return chosen;
    const Vec3 normal = eigen.eigenvectors().col(0);
    const auto off =
        std::find_if(candidates.begin() + static_cast<std::ptrdiff_t>(count), candidates.end(),
                     [&](const Candidate& c) {
                       return std::abs(normal.dot(model.rest[c.node] - mean)) > kOffPlane * width;
                     });
    if (off == candidates.end()) return chosen;
    chosen[count - 1 - round] = *off;
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// Nodes up to two springs away from `centre`, including it. `mark` holds N zeros before and after.
std::vector<std::uint32_t> two_springs_around(std::uint32_t centre, const SpringRows& springs,
                                              std::vector<std::uint8_t>& mark) {
  std::vector<std::uint32_t> found{centre};
  mark[centre] = 1;
  std::size_t ring_end = 1;
  std::size_t next = 0;
  for (int ring = 0; ring < 2; ++ring) {
    for (; next < ring_end; ++next)
      springs.for_each(found[next], [&](std::uint32_t node, std::uint32_t) {
        if (mark[node] != 0) return;
        mark[node] = 1;
        found.push_back(node);
      });
    ring_end = found.size();
  }
  for (const std::uint32_t node : found) mark[node] = 0;
  return found;
}

/// Interface to a set of points that nanoflann requires.
struct NodeCloud {
  const std::vector<Vec3>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t dimension) const {
    return points[i][static_cast<Eigen::Index>(dimension)];
  }
  template <class Box>
  bool kdtree_get_bbox(Box& /*box*/) const {
    return false;
  }
};
using NodeTree =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, NodeCloud>, NodeCloud,
                                        3, std::uint32_t>;

}  // namespace

void validate(const Binding& binding, std::uint32_t node_count) {
  if (binding.node.size() != binding.weight.size())
    throw InputError(fmt::format("binding: {} nodes, but {} weights", binding.node.size(),
                                 binding.weight.size()));
  if (binding.start.empty()
          ? !binding.node.empty()
          : binding.start.front() != 0 || binding.start.back() != binding.node.size() ||
                !std::is_sorted(binding.start.begin(), binding.start.end()))
    throw InputError("binding: start must rise from 0 to the number of entries");
  for (std::size_t e = 0; e < binding.node.size(); ++e) {
    if (binding.node[e] >= node_count)
      throw InputError(fmt::format("binding: entry {} names node {}, but there are only {}",
                                   script_number(e), script_number(binding.node[e]), node_count));
    if (!(std::abs(binding.weight[e]) <= kLargestWeight))
      throw InputError(fmt::format("binding: the weight {} of entry {} must lie between {} and {}",
                                   binding.weight[e], script_number(e), -kLargestWeight,
                                   kLargestWeight));
  }
  for (std::uint32_t p = 0; p < binding.point_count(); ++p) {
    const auto begin = binding.weight.begin();
    const double sum = std::accumulate(begin + binding.start[p], begin + binding.start[p + 1], 0.0);
    if (!(std::abs(sum - 1) <= kWeightRounding))
      throw InputError(fmt::format("binding: the weights of point {} add up to {}, not to 1",
                                   script_number(p), sum));
  }
}

void append_bound_point(Binding& binding, const Vec3& point, const MassSpringModel& model,
                        const std::vector<std::uint32_t>& nodes) {
  if (nodes.empty())
    throw InputError("binding: the point has no candidate nodes; give at least one");
  append_weights(binding, point, model, by_distance(point, model, nodes));
}

Binding bind_points(const std::vector<Vec3>& points, const MassSpringModel& model) {
  if (model.rest.empty()) throw InputError("binding: the model has no nodes to bind points to");
  const NodeCloud cloud{model.rest};
  const NodeTree tree(3, cloud);
  const SpringRows springs(model);
  std::vector<std::uint8_t> mark(model.node_count(), 0);
  Binding binding;
  binding.start.reserve(points.size() + 1);
  binding.start.push_back(0);
  for (const Vec3& point : points) {
    std::uint32_t nearest = 0;
    double distance2 = 0;
    tree.knnSearch(point.data(), 1, &nearest, &distance2);
    const auto around = two_springs_around(nearest, springs, mark);
    const auto candidates = by_distance(point, model, around);
    append_weights(binding, point, model, choose(candidates, kNodesPerPoint, model));
  }
  return binding;
}

Binding compose(const Binding& outer, const Binding& inner) {
  Binding composed;
  composed.start.push_back(0);
  std::vector<std::pair<std::uint32_t, double>> row;
  for (std::uint32_t p = 0; p < outer.point_count(); ++p) {
    row.clear();
    for (std::uint32_t e = outer.start[p]; e < outer.start[p + 1]; ++e) {
      const std::uint32_t q = outer.node[e];
      if (q >= inner.point_count())
        throw InputError(fmt::format("binding: point {} refers to point {}, but there are only {}",
                                     script_number(p), script_number(q), inner.point_count()));
      for (std::uint32_t f = inner.start[q]; f < inner.start[q + 1]; ++f)
        row.emplace_back(inner.node[f], outer.weight[e] * inner.weight[f]);
    }
    std::stable_sort(row.begin(), row.end(),
                     [](const auto& x, const auto& y) { return x.first < y.first; });
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0 && row[i].first == row[i - 1].first) {
        composed.weight.back() += row[i].second;
      } else {
        composed.node.push_back(row[i].first);
        composed.weight.push_back(row[i].second);
      }
    }
    end_row(composed);
  }
  return composed;
}

std::vector<Vec3> interpolate(const Binding& binding, const std::vector<Vec3>& nodes) {
  std::vector<Vec3> points(binding.point_count(), Vec3::Zero());
  for (std::uint32_t p = 0; p < binding.point_count(); ++p)
    for (std::uint32_t e = binding.start[p]; e < binding.start[p + 1]; ++e)
      points[p] += binding.weight[e] * nodes[binding.node[e]];
  return points;
}

}  // namespace springlod::inline model
