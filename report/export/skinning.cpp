#include "report/export/skinning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "model/spring_rows.hpp"
#include "report/export/motion_files.hpp"

namespace springlod::report {

namespace {

/// Frames from which weights are fitted: some poses of a motion say as much as all.
constexpr std::size_t kFittedFrames = 16;
/// Nodes of which a vertex may get a weight: those with the largest weights in its binding.
constexpr std::size_t kCandidates = 12;
/// Share of the whole body's rotation in that of a node, relative to its springs [1]: decides about
/// turns that they leave open, such as those about a single line of springs, and no others.
constexpr double kBodyShare = 1e-3;
/// Added to the diagonal of the normal equations, relative to their largest entry [1]: candidates
/// that move alike share a weight.
constexpr double kRidge = 1e-9;

// The rotation R with the least |R A - B|, from H = B A^T.
Mat3 nearest_rotation(const Mat3& h) {
  const Eigen::JacobiSVD<Mat3> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Mat3 sign = Mat3::Identity();
  if ((svd.matrixU() * svd.matrixV().transpose()).determinant() < 0) sign(2, 2) = -1;
  return svd.matrixU() * sign * svd.matrixV().transpose();
}

Mat3 body_rotation(const MassSpringModel& model, const std::vector<Vec3>& x) {
  const Vec3 rest_center = center_of_mass(model, model.rest), center = center_of_mass(model, x);
  Mat3 h = Mat3::Zero();
  for (std::uint32_t i = 0; i < model.node_count(); ++i)
    h += model.mass[i] * (x[i] - center) * (model.rest[i] - rest_center).transpose();
  return nearest_rotation(h);
}

Vec3 posed(const NodePoses& poses, const MassSpringModel& model, std::uint32_t node,
           const Vec3& vertex) {
  return poses.rotation[node] * (vertex - model.rest[node]) + poses.position[node];
}

// The w >= 0 with the sum 1 that make w^T G w least, by an active set.
Eigen::VectorXd least_on_simplex(Eigen::MatrixXd g) {
  const Eigen::Index n = g.rows();
  const double scale = g.diagonal().maxCoeff();
  // All follow the vertex exactly, such as the one node that it lies at.
  if (!(scale > 0)) return Eigen::VectorXd::Unit(n, 0);
  g /= scale;
  g.diagonal().array() += kRidge;
  std::vector<Eigen::Index> used(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) used[static_cast<std::size_t>(i)] = i;
  for (;;) {
    const auto size = static_cast<Eigen::Index>(used.size());
    const Eigen::MatrixXd part = g(used, used);
    Eigen::VectorXd some = part.ldlt().solve(Eigen::VectorXd::Ones(size));
    some /= some.sum();
    Eigen::Index lowest = 0;
    if (size == 1 || some.minCoeff(&lowest) >= 0) {
      Eigen::VectorXd all = Eigen::VectorXd::Zero(n);
      for (Eigen::Index i = 0; i < size; ++i) all(used[static_cast<std::size_t>(i)]) = some(i);
      return all;
    }
    used.erase(used.begin() + lowest);
  }
}

// Positions of a vertex in some frames, and where each candidate alone would bring it.
class VertexFit {
 public:
  VertexFit(const MassSpringModel& model, const std::vector<const NodePoses*>& poses,
            const std::vector<std::vector<Vec3>>& surfaces)
      : model_(model), poses_(poses), surfaces_(surfaces) {}

  /// Weights of the nodes for vertex `p`, at most `influences` of them above 0.
  Eigen::VectorXd weights(std::uint32_t p, const Vec3& rest,
                          const std::vector<std::uint32_t>& nodes, std::uint32_t influences) const {
    Eigen::MatrixXd misses(3 * static_cast<Eigen::Index>(poses_.size()),
                           static_cast<Eigen::Index>(nodes.size()));
    for (std::size_t f = 0; f < poses_.size(); ++f)
      for (std::size_t c = 0; c < nodes.size(); ++c)
        misses.block<3, 1>(3 * static_cast<Eigen::Index>(f), static_cast<Eigen::Index>(c)) =
            posed(*poses_[f], model_, nodes[c], rest) - surfaces_[f][p];
    const Eigen::MatrixXd g = misses.transpose() * misses;
    const Eigen::VectorXd all = least_on_simplex(g);
    std::vector<Eigen::Index> order(nodes.size());
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = static_cast<Eigen::Index>(c);
    std::stable_sort(order.begin(), order.end(),
                     [&](Eigen::Index a, Eigen::Index b) { return all(a) > all(b); });
    order.resize(std::min<std::size_t>(order.size(), influences));
    const auto size = static_cast<Eigen::Index>(order.size());
    const Eigen::VectorXd some = least_on_simplex(g(order, order));
    Eigen::VectorXd kept = Eigen::VectorXd::Zero(g.rows());
    for (Eigen::Index i = 0; i < size; ++i) kept(order[static_cast<std::size_t>(i)]) = some(i);
    return kept;
  }

 private:
  const MassSpringModel& model_;
  const std::vector<const NodePoses*>& poses_;
  const std::vector<std::vector<Vec3>>& surfaces_;
};

std::vector<std::uint32_t> candidates(const Binding& binding, std::uint32_t p) {
  std::vector<std::uint32_t> entries;
  for (std::uint32_t e = binding.start[p]; e < binding.start[p + 1]; ++e) entries.push_back(e);
  std::stable_sort(entries.begin(), entries.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::abs(binding.weight[a]) > std::abs(binding.weight[b]);
  });
  entries.resize(std::min(entries.size(), kCandidates));
  for (std::uint32_t& entry : entries) entry = binding.node[entry];
  return entries;
}

// Numbers the nodes that move a vertex; `joint` holds nodes before, joints after.
void number_joints(Skinning& skinning, std::uint32_t node_count) {
  constexpr auto kNone = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(node_count, kNone);
  for (std::size_t e = 0; e < skinning.joint.size(); ++e)
    if (skinning.weight[e] > 0) number[skinning.joint[e]] = 0;
  for (std::uint32_t node = 0; node < node_count; ++node)
    if (number[node] != kNone) {
      number[node] = static_cast<std::uint32_t>(skinning.node.size());
      skinning.node.push_back(node);
    }
  for (std::size_t e = 0; e < skinning.joint.size(); ++e)
    skinning.joint[e] = skinning.weight[e] > 0 ? number[skinning.joint[e]] : 0;
}

void measure_errors(Skinning& skinning, const ExportedMotion& motion, const std::vector<Vec3>& rest,
                    const std::vector<NodePoses>& poses) {
  double sum = 0, largest = 0;
  for (std::size_t f = 0; f < poses.size(); ++f) {
    const std::vector<Vec3> surface = surface_at(motion.body, motion.frames[f].x);
    for (std::size_t p = 0; p < surface.size(); ++p) {
      Vec3 skinned = Vec3::Zero();
      for (std::size_t e = p * skinning.influences; e < (p + 1) * skinning.influences; ++e)
        if (skinning.weight[e] > 0)
          skinned += static_cast<double>(skinning.weight[e]) *
                     posed(poses[f], motion.body.model, skinning.node[skinning.joint[e]], rest[p]);
      const double square = (skinned - surface[p]).squaredNorm();
      sum += square;
      largest = std::max(largest, square);
    }
  }
  skinning.mean_error = std::sqrt(sum / static_cast<double>(poses.size() * rest.size()));
  skinning.largest_error = std::sqrt(largest);
}

}  // namespace

NodePoses node_poses(const MassSpringModel& model, const std::vector<Vec3>& x) {
  const SpringRows rows(model);
  const Mat3 body = body_rotation(model, x);
  NodePoses poses{x, {}};
  poses.rotation.reserve(x.size());
  for (std::uint32_t i = 0; i < model.node_count(); ++i) {
    Mat3 h = Mat3::Zero();
    double squares = 0;
    rows.for_each(i, [&](std::uint32_t j, std::uint32_t) {
      const Vec3 rest = model.rest[j] - model.rest[i];
      h += (x[j] - x[i]) * rest.transpose();
      squares += rest.squaredNorm();
    });
    h += kBodyShare * (squares > 0 ? squares : 1) * body;
    poses.rotation.emplace_back(nearest_rotation(h));
  }
  return poses;
}

Skinning fit_skinning(const ExportedMotion& motion, const std::vector<NodePoses>& poses,
                      std::uint32_t influences) {
  const ExportedModel& body = motion.body;
  const std::vector<Vec3> rest = surface_points(body);
  const NodePoses still = node_poses(body.model, body.model.rest);
  std::vector<const NodePoses*> fitted{&still};
  std::vector<std::vector<Vec3>> surfaces{rest};
  const std::size_t count = std::min(kFittedFrames, poses.size());
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t f = count == 1 ? 0 : n * (poses.size() - 1) / (count - 1);
    fitted.push_back(&poses[f]);
    surfaces.push_back(surface_at(body, motion.frames[f].x));
  }
  const VertexFit fit(body.model, fitted, surfaces);
  Skinning skinning;
  skinning.influences = influences;
  skinning.joint.assign(rest.size() * influences, 0);
  skinning.weight.assign(rest.size() * influences, 0);
  for (std::uint32_t p = 0; p < rest.size(); ++p) {
    const std::vector<std::uint32_t> nodes = candidates(body.surface_of_nodes, p);
    const Eigen::VectorXd weights = fit.weights(p, rest[p], nodes, influences);
    std::size_t entry = std::size_t{p} * influences;
    for (std::size_t c = 0; c < nodes.size(); ++c)
      if (weights(static_cast<Eigen::Index>(c)) > 0) {
        skinning.joint[entry] = nodes[c];
        skinning.weight[entry++] = static_cast<float>(weights(static_cast<Eigen::Index>(c)));
      }
  }
  number_joints(skinning, body.model.node_count());
  measure_errors(skinning, motion, rest, poses);
  return skinning;
}

}  // namespace springlod::report
