#include "elastic/zero_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include "base/error.hpp"
#include "elastic/rigid_clusters.hpp"
#include "elastic/solver/random_block.hpp"
#include "model/anchors.hpp"

namespace springlod::elastic {
namespace {

/// Eigenvalues of the stiffness of unit springs below this count as zero: far above rounding
/// (1e-15), far below the softest mode of a beam of a hundred nodes (some 1e-7).
constexpr double kZero = 1e-10;
/// Number of random motions that are projected on the mechanisms. The probability that all of them
/// are orthogonal to the motion of a node is negligible.
constexpr Eigen::Index kProbes = 8;
/// A node belongs to a mechanism if it moves more than this fraction of the largest motion.
constexpr double kMoves = 1e-3;

/// Nodes that move as one rigid body: a rigid cluster with six degrees of freedom, or a single node
/// with three.
struct Body {
  std::vector<std::uint32_t> nodes;
  bool rigid = false;
  Eigen::Index first_unknown = -1;  // -1: the body is held fixed
  Vec3 centre = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // of rotation
  Vec3 arm = Vec3::Ones();       // sqrt(sum |axis x r|^2) for each axis
  Eigen::Index unknowns() const { return rigid ? 6 : 3; }
};

void measure(Body& body, const MassSpringModel& model) {
  if (!body.rigid) return;
  for (const std::uint32_t i : body.nodes)
    body.centre += model.rest[i] / static_cast<double>(body.nodes.size());
  Mat3 inertia = Mat3::Zero();
  for (const std::uint32_t i : body.nodes) {
    const Vec3 r = model.rest[i] - body.centre;
    inertia += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(inertia);
  body.axes = eigen.eigenvectors();
  body.arm = eigen.eigenvalues().cwiseSqrt();
}

/// Displacement of a node for each unknown of its body. Over all nodes the columns are orthonormal,
/// so the eigenvalues lie between those of the whole model.
Eigen::Matrix3Xd motions(const Body& body, const Vec3& rest) {
  if (!body.rigid) return Mat3::Identity();
  Eigen::Matrix3Xd columns(3, 6);
  columns.leftCols<3>() = Mat3::Identity() / std::sqrt(static_cast<double>(body.nodes.size()));
  for (int d = 0; d < 3; ++d) {
    const Vec3 axis = body.axes.col(d);
    columns.col(3 + d) = axis.cross(rest - body.centre) / body.arm[d];
  }
  return columns;
}

/// A connected component, its bodies and the stiffness of unit springs between them.
struct Component {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> springs;
  std::vector<Body> bodies;
  std::uint32_t anchored = 0;  // nodes
  Eigen::Index unknowns = 0;
  bool has_resting_body = false;
};

class ZeroModes {
 public:
  ZeroModes(const MassSpringModel& model, const std::vector<std::uint32_t>& anchored)
      : model_(model), held_(anchor_flags(model, anchored)), body_of_(model.node_count(), 0) {}

  std::vector<ComponentModes> run() {
    std::vector<ComponentModes> all;
    for (Component& component : components()) all.push_back(solve(component));
    return all;
  }

 private:
  std::vector<Component> components() {
    const Components connected = connected_components(model_);
    const RigidClusters clusters = rigid_clusters(model_);
    std::vector<Component> components(connected.count);
    constexpr std::uint32_t kNone = kNoCluster;
    std::vector<std::uint32_t> body_of_cluster(clusters.count, kNone);
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) {
      Component& component = components[connected.of_node[i]];
      component.nodes.push_back(i);
      component.anchored += held_[i];
      const std::uint32_t cluster = clusters.of_node[i];
      std::uint32_t body = cluster == kNoCluster ? kNone : body_of_cluster[cluster];
      if (body == kNone) {
        body = static_cast<std::uint32_t>(component.bodies.size());
        component.bodies.emplace_back().rigid = cluster != kNoCluster;
        if (cluster != kNoCluster) body_of_cluster[cluster] = body;
      }
      body_of_[i] = body;
      component.bodies[body].nodes.push_back(i);
    }
    for (std::uint32_t s = 0; s < model_.spring_count(); ++s)
      components[connected.of_node[model_.a[s]]].springs.push_back(s);
    for (Component& component : components) number_unknowns(component);
    return components;
  }

  void number_unknowns(Component& component) const {
    const auto largest = std::max_element(
        component.bodies.begin(), component.bodies.end(), [](const Body& p, const Body& q) {
          return std::pair(p.rigid, p.nodes.size()) < std::pair(q.rigid, q.nodes.size());
        });
    // In an anchored component the largest cluster may still rotate about the anchors.
    component.has_resting_body = largest->rigid && component.anchored == 0;
    for (Body& body : component.bodies) {
      measure(body, model_);
      if (component.has_resting_body && &body == &*largest) continue;
      body.first_unknown = component.unknowns;
      component.unknowns += body.unknowns();
    }
  }

  /// Three unit springs, one along each axis, from a node at `rest` to the ground.
  static void add_ground(const Body& body, const Vec3& rest,
                         std::vector<Eigen::Triplet<double>>& entries) {
    const Eigen::Matrix3Xd columns = motions(body, rest);
    const Eigen::MatrixXd block = columns.transpose() * columns;
    for (Eigen::Index i = 0; i < block.rows(); ++i)
      for (Eigen::Index j = 0; j < block.cols(); ++j)
        entries.emplace_back(static_cast<int>(body.first_unknown + i),
                             static_cast<int>(body.first_unknown + j), block(i, j));
  }

  Eigen::SparseMatrix<double> stiffness(const Component& component) const {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<std::pair<Eigen::Index, double>> row;
    for (const std::uint32_t s : component.springs) {
      const std::uint32_t a = model_.a[s];
      const std::uint32_t b = model_.b[s];
      if (body_of_[a] == body_of_[b]) continue;
      row.clear();
      const Vec3 u = spring_direction(model_, s);
      for (const auto& [node, sign] : {std::pair(a, -1.0), std::pair(b, 1.0)}) {
        const Body& body = component.bodies[body_of_[node]];
        if (body.first_unknown < 0) continue;
        const Eigen::VectorXd along = motions(body, model_.rest[node]).transpose() * u;
        for (Eigen::Index d = 0; d < along.size(); ++d)
          row.emplace_back(body.first_unknown + d, sign * along[d]);
      }
      for (const auto& [i, x] : row)
        for (const auto& [j, y] : row)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(j), x * y);
    }
    for (const std::uint32_t i : component.nodes)
      if (held_[i] != 0) add_ground(component.bodies[body_of_[i]], model_.rest[i], entries);
    Eigen::SparseMatrix<double> matrix(component.unknowns, component.unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// Orthonormal rigid motions of a component without rigid clusters.
  Eigen::MatrixXd rigid_motions(const Component& component) const {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t i : component.nodes)
      centre += model_.rest[i] / static_cast<double>(component.nodes.size());
    double size = 0;
    for (const std::uint32_t i : component.nodes)
      size = std::max(size, (model_.rest[i] - centre).norm());
    if (size == 0) size = 1;
    Eigen::MatrixXd motion(component.unknowns, 6);
    for (const std::uint32_t i : component.nodes) {
      const Eigen::Index row = component.bodies[body_of_[i]].first_unknown;
      const Vec3 r = (model_.rest[i] - centre) / size;
      motion.block<3, 3>(row, 0) = Mat3::Identity();
      for (int d = 0; d < 3; ++d) motion.block<3, 1>(row, 3 + d) = Vec3::Unit(d).cross(r);
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(motion);
    constexpr double kStraight = 1e-9;  // width / length at which nodes count as collinear
    qr.setThreshold(kStraight);
    return qr.householderQ() * Eigen::MatrixXd::Identity(component.unknowns, qr.rank());
  }

  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  /// Eigenvalues below kZero: the negative pivots of the shifted matrix.
  static std::uint32_t count_zeros(const Eigen::SparseMatrix<double>& stiffness) {
    if (stiffness.rows() == 0) return 0;
    Factor factor;
    factor.analyzePattern(stiffness);
    // If a pivot is exactly zero, the factorization is repeated with another shift.
    for (const double shift : {1.0, 1.37, 1.88, 2.57, 3.52, 4.83}) {
      factor.setShift(-shift * kZero);
      factor.factorize(stiffness);
      if (factor.info() == Eigen::Success)
        return static_cast<std::uint32_t>((factor.vectorD().array() < 0).count());
    }
    throw InputError(
        "zero modes: the stiffness of the model cannot be factorised; check that its "
        "nodes do not coincide");
  }

  /// Random motions; all but the zero modes are filtered out, and of these the rigid motions.
  static Eigen::MatrixXd mechanism_motions(const Eigen::SparseMatrix<double>& stiffness,
                                           const Eigen::MatrixXd& rigid) {
    Eigen::MatrixXd motion = random_block(stiffness.rows(), kProbes, 1);
    Factor factor;
    factor.setShift(kZero);
    factor.compute(stiffness);
    for (int pass = 0; pass < 2; ++pass) {
      if (rigid.cols() > 0) motion -= rigid * (rigid.transpose() * motion).eval();
      motion = (kZero * factor.solve(motion)).eval();
    }
    if (rigid.cols() > 0) motion -= rigid * (rigid.transpose() * motion).eval();
    return motion;
  }

  std::vector<std::uint32_t> moving_nodes(const Component& component,
                                          const Eigen::MatrixXd& motion) const {
    std::vector<std::pair<double, std::uint32_t>> moves;
    double most = 0;
    for (const Body& body : component.bodies) {
      if (body.first_unknown < 0) continue;
      for (const std::uint32_t i : body.nodes) {
        const double move =
            (motions(body, model_.rest[i]) * motion.middleRows(body.first_unknown, body.unknowns()))
                .norm();
        moves.emplace_back(-move, i);  // the largest first, then by node
        most = std::max(most, move);
      }
    }
    std::sort(moves.begin(), moves.end());
    std::vector<std::uint32_t> nodes;
    for (const auto& [move, node] : moves)
      if (-move > kMoves * most) nodes.push_back(node);
    return nodes;
  }

  ComponentModes solve(const Component& component) const {
    ComponentModes modes;
    modes.first_node = component.nodes.front();
    modes.node_count = static_cast<std::uint32_t>(component.nodes.size());
    modes.anchored = component.anchored;
    const Eigen::SparseMatrix<double> k = stiffness(component);
    Eigen::MatrixXd rigid(component.unknowns, 0);
    modes.zero_modes = count_zeros(k);
    if (component.anchored > 0) {
      modes.expected = 0;
    } else if (component.has_resting_body) {
      modes.zero_modes += 6;  // those of the body that is held fixed
    } else {
      rigid = rigid_motions(component);
      modes.expected = static_cast<std::uint32_t>(rigid.cols());
    }
    if (modes.zero_modes > modes.expected)
      modes.mechanism_nodes = moving_nodes(component, mechanism_motions(k, rigid));
    return modes;
  }

  const MassSpringModel& model_;
  std::vector<std::uint8_t> held_;      // 1 for anchored nodes
  std::vector<std::uint32_t> body_of_;  // node -> body within its component
};

}  // namespace

std::vector<ComponentModes> zero_modes(const MassSpringModel& model,
                                       const std::vector<std::uint32_t>& anchored) {
  return ZeroModes(model, anchored).run();
}

}  // namespace springlod::elastic
