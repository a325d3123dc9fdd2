#include "elastic/rigid_pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

namespace springlod::elastic {
namespace {

/// Three unit vectors whose determinant is smaller count as lying in a plane; so do directions
/// whose tensor has a smaller determinant than the square of it. Any value above rounding would do:
/// what is in doubt is left out, and solved for.
constexpr double kFlat = 1e-3;

class Growth {
 public:
  explicit Growth(const MassSpringModel& model)
      : model_(model),
        adj_(adjacency(model)),
        pieces_{std::vector<std::uint32_t>(model.node_count(), kNoPiece), 0},
        touching_(model.node_count()) {}

  RigidPieces run() {
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) {
      if (!is_free(i)) continue;
      if (const auto seed = tetrahedron_at(i)) grow(*seed);
    }
    return pieces_;
  }

 private:
  /// Springs of a node to the piece that grows just now.
  struct Touching {
    std::uint32_t piece = kNoPiece;
    Mat3 directions = Mat3::Zero();  // sum of u u^T
  };

  bool is_free(std::uint32_t i) const { return pieces_.of_node[i] == kNoPiece; }
  bool joined(std::uint32_t i, std::uint32_t j) const {
    return std::binary_search(adj_.neighbour.begin() + adj_.start[i],
                              adj_.neighbour.begin() + adj_.start[i + 1], j);
  }

  bool solid(const std::array<std::uint32_t, 4>& t) const {
    Mat3 edges;
    for (int d = 0; d < 3; ++d)
      edges.col(d) =
          (model_.rest[t[static_cast<std::size_t>(d) + 1]] - model_.rest[t[0]]).normalized();
    return std::abs(edges.determinant()) > kFlat;
  }

  /// Four free nodes, i the lowest, each joined to each by springs and not in one plane.
  std::optional<std::array<std::uint32_t, 4>> tetrahedron_at(std::uint32_t i) const {
    std::vector<std::uint32_t> around;
    for (std::uint32_t e = adj_.start[i]; e < adj_.start[i + 1]; ++e)
      if (adj_.neighbour[e] > i && is_free(adj_.neighbour[e])) around.push_back(adj_.neighbour[e]);
    for (std::size_t j = 0; j < around.size(); ++j)
      for (std::size_t k = j + 1; k < around.size(); ++k) {
        if (!joined(around[j], around[k])) continue;
        for (std::size_t l = k + 1; l < around.size(); ++l) {
          if (!joined(around[j], around[l]) || !joined(around[k], around[l])) continue;
          const std::array<std::uint32_t, 4> found{i, around[j], around[k], around[l]};
          if (solid(found)) return found;
        }
      }
    return std::nullopt;
  }

  void grow(const std::array<std::uint32_t, 4>& seed) {
    const std::uint32_t piece = pieces_.count++;
    std::vector<std::uint32_t> fresh(seed.begin(), seed.end());
    for (const std::uint32_t i : seed) pieces_.of_node[i] = piece;
    while (!fresh.empty()) {
      const std::uint32_t i = fresh.back();
      fresh.pop_back();
      for (std::uint32_t e = adj_.start[i]; e < adj_.start[i + 1]; ++e) {
        const std::uint32_t j = adj_.neighbour[e];
        if (!is_free(j)) continue;
        Touching& touching = touching_[j];
        if (touching.piece != piece) touching = {piece, Mat3::Zero()};
        const Vec3 u = spring_direction(model_, adj_.spring[e]);
        touching.directions += u * u.transpose();
        if (touching.directions.determinant() <= kFlat * kFlat) continue;
        pieces_.of_node[j] = piece;
        fresh.push_back(j);
      }
    }
  }

  const MassSpringModel& model_;
  Adjacency adj_;
  RigidPieces pieces_;
  std::vector<Touching> touching_;
};

}  // namespace

RigidPieces rigid_pieces(const MassSpringModel& model) {
  return Growth(model).run();
}

}  // namespace springlod::elastic
