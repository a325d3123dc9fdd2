#include "elastic/zero_modes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SparseCholesky>

#include "base/error.hpp"
#include "elastic/rigid_pieces.hpp"
#include "elastic/solver/random_block.hpp"
#include "model/anchors.hpp"

namespace springlod::elastic {
namespace {

/// Eigenvalues of the stiffness of unit springs below this are zero: far above rounding (1e-15),
/// far below the softest motion of a sound body (some 1e-7 for a beam of a hundred nodes).
constexpr double kZero = 1e-10;
/// Random motions whose part in the mechanisms is looked at: the chance that all of them miss a
/// node's motion is nil.
constexpr Eigen::Index kProbes = 8;
/// A node takes part in a mechanism if it moves more than this part of the one that moves most.
constexpr double kMoves = 1e-3;

/// Nodes that move as one: a rigid piece with six ways to move, or a single node with three.
struct Body {
  std::vector<std::uint32_t> nodes;
  bool rigid = false;
  Eigen::Index first_unknown = -1;  // -1: at rest
  Vec3 centre = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  // of rotation
  Vec3 swing = Vec3::Ones();     // sqrt(sum |axis x r|^2) for each axis
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
  body.swing = eigen.eigenvalues().cwiseSqrt();
}

/// Displacement of node i for each unknown of its body. The columns over all nodes are orthonormal,
/// so eigenvalues lie between those of the whole model.
Eigen::Matrix3Xd motions(const Body& body, const Vec3& rest) {
  if (!body.rigid) return Mat3::Identity();
  Eigen::Matrix3Xd columns(3, 6);
  columns.leftCols<3>() = Mat3::Identity() / std::sqrt(static_cast<double>(body.nodes.size()));
  for (int d = 0; d < 3; ++d) {
    const Vec3 axis = body.axes.col(d);
    columns.col(3 + d) = axis.cross(rest - body.centre) / body.swing[d];
  }
  return columns;
}

/// One connected part, its bodies and the stiffness of unit springs between them.
struct Part {
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

  std::vector<PartModes> run() {
    std::vector<PartModes> all;
    for (Part& part : parts()) all.push_back(solve(part));
    return all;
  }

 private:
  std::vector<Part> parts() {
    const Components components = connected_components(model_);
    const RigidPieces pieces = rigid_pieces(model_);
    std::vector<Part> parts(components.count);
    constexpr std::uint32_t kNone = kNoPiece;
    std::vector<std::uint32_t> body_of_piece(pieces.count, kNone);
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) {
      Part& part = parts[components.of_node[i]];
      part.nodes.push_back(i);
      part.anchored += held_[i];
      const std::uint32_t piece = pieces.of_node[i];
      std::uint32_t body = piece == kNoPiece ? kNone : body_of_piece[piece];
      if (body == kNone) {
        body = static_cast<std::uint32_t>(part.bodies.size());
        part.bodies.emplace_back().rigid = piece != kNoPiece;
        if (piece != kNoPiece) body_of_piece[piece] = body;
      }
      body_of_[i] = body;
      part.bodies[body].nodes.push_back(i);
    }
    for (std::uint32_t s = 0; s < model_.spring_count(); ++s)
      parts[components.of_node[model_.a[s]]].springs.push_back(s);
    for (Part& part : parts) number_unknowns(part);
    return parts;
  }

  void number_unknowns(Part& part) const {
    const auto largest =
        std::max_element(part.bodies.begin(), part.bodies.end(), [](const Body& p, const Body& q) {
          return std::pair(p.rigid, p.nodes.size()) < std::pair(q.rigid, q.nodes.size());
        });
    // Where nodes are anchored, the largest piece may still turn about them.
    part.has_resting_body = largest->rigid && part.anchored == 0;
    for (Body& body : part.bodies) {
      measure(body, model_);
      if (part.has_resting_body && &body == &*largest) continue;
      body.first_unknown = part.unknowns;
      part.unknowns += body.unknowns();
    }
  }

  /// Three unit springs, one an axis, from a node at `rest` to the ground.
  static void add_ground(const Body& body, const Vec3& rest,
                         std::vector<Eigen::Triplet<double>>& entries) {
    const Eigen::Matrix3Xd columns = motions(body, rest);
    const Eigen::MatrixXd block = columns.transpose() * columns;
    for (Eigen::Index i = 0; i < block.rows(); ++i)
      for (Eigen::Index j = 0; j < block.cols(); ++j)
        entries.emplace_back(static_cast<int>(body.first_unknown + i),
                             static_cast<int>(body.first_unknown + j), block(i, j));
  }

  Eigen::SparseMatrix<double> stiffness(const Part& part) const {
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<std::pair<Eigen::Index, double>> row;
    for (const std::uint32_t s : part.springs) {
      const std::uint32_t a = model_.a[s];
      const std::uint32_t b = model_.b[s];
      if (body_of_[a] == body_of_[b]) continue;
      row.clear();
      const Vec3 u = spring_direction(model_, s);
      for (const auto& [node, sign] : {std::pair(a, -1.0), std::pair(b, 1.0)}) {
        const Body& body = part.bodies[body_of_[node]];
        if (body.first_unknown < 0) continue;
        const Eigen::VectorXd along = motions(body, model_.rest[node]).transpose() * u;
        for (Eigen::Index d = 0; d < along.size(); ++d)
          row.emplace_back(body.first_unknown + d, sign * along[d]);
      }
      for (const auto& [i, x] : row)
        for (const auto& [j, y] : row)
          entries.emplace_back(static_cast<int>(i), static_cast<int>(j), x * y);
    }
    for (const std::uint32_t i : part.nodes)
      if (held_[i] != 0) add_ground(part.bodies[body_of_[i]], model_.rest[i], entries);
    Eigen::SparseMatrix<double> matrix(part.unknowns, part.unknowns);
    matrix.setFromTriplets(entries.begin(), entries.end());
    return matrix;
  }

  /// Orthonormal rigid motions of a part all of whose bodies are single nodes.
  Eigen::MatrixXd rigid_motions(const Part& part) const {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t i : part.nodes)
      centre += model_.rest[i] / static_cast<double>(part.nodes.size());
    double size = 0;
    for (const std::uint32_t i : part.nodes)
      size = std::max(size, (model_.rest[i] - centre).norm());
    if (size == 0) size = 1;
    Eigen::MatrixXd motion(part.unknowns, 6);
    for (const std::uint32_t i : part.nodes) {
      const Eigen::Index row = part.bodies[body_of_[i]].first_unknown;
      const Vec3 r = (model_.rest[i] - centre) / size;
      motion.block<3, 3>(row, 0) = Mat3::Identity();
      for (int d = 0; d < 3; ++d) motion.block<3, 1>(row, 3 + d) = Vec3::Unit(d).cross(r);
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(motion);
    constexpr double kStraight = 1e-9;  // width over length at which nodes lie in a line
    qr.setThreshold(kStraight);
    return qr.householderQ() * Eigen::MatrixXd::Identity(part.unknowns, qr.rank());
  }

  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

  /// Eigenvalues below kZero: the negative pivots of the shifted matrix.
  static std::uint32_t count_zeros(const Eigen::SparseMatrix<double>& stiffness) {
    if (stiffness.rows() == 0) return 0;
    Factor factor;
    factor.analyzePattern(stiffness);
    // A pivot that vanishes exactly is bad luck, which another shift does not have.
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

  /// Random motions with all but the zero modes, and of these the rigid ones, filtered out.
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

  std::vector<std::uint32_t> moving_nodes(const Part& part, const Eigen::MatrixXd& motion) const {
    std::vector<std::pair<double, std::uint32_t>> moves;
    double most = 0;
    for (const Body& body : part.bodies) {
      if (body.first_unknown < 0) continue;
      for (const std::uint32_t i : body.nodes) {
        const double move =
            (motions(body, model_.rest[i]) * motion.middleRows(body.first_unknown, body.unknowns()))
                .norm();
        moves.emplace_back(-move, i);  // sorts the farthest first, then by node
        most = std::max(most, move);
      }
    }
    std::sort(moves.begin(), moves.end());
    std::vector<std::uint32_t> nodes;
    for (const auto& [move, node] : moves)
      if (-move > kMoves * most) nodes.push_back(node);
    return nodes;
  }

  PartModes solve(const Part& part) const {
    PartModes modes;
    modes.first_node = part.nodes.front();
    modes.node_count = static_cast<std::uint32_t>(part.nodes.size());
    modes.anchored = part.anchored;
    const Eigen::SparseMatrix<double> k = stiffness(part);
    Eigen::MatrixXd rigid(part.unknowns, 0);
    modes.zero_modes = count_zeros(k);
    if (part.anchored > 0) {
      modes.expected = 0;
    } else if (part.has_resting_body) {
      modes.zero_modes += 6;  // those of the body at rest
    } else {
      rigid = rigid_motions(part);
      modes.expected = static_cast<std::uint32_t>(rigid.cols());
    }
    if (modes.zero_modes > modes.expected)
      modes.mechanism_nodes = moving_nodes(part, mechanism_motions(k, rigid));
    return modes;
  }

  const MassSpringModel& model_;
  std::vector<std::uint8_t> held_;      // 1 for anchored nodes
  std::vector<std::uint32_t> body_of_;  // node -> body within its part
};

}  // namespace

std::vector<PartModes> zero_modes(const MassSpringModel& model,
                                  const std::vector<std::uint32_t>& anchored) {
  return ZeroModes(model, anchored).run();
}

}  // namespace springlod::elastic
