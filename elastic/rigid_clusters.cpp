#include "elastic/rigid_clusters.hpp"

#include <array>
#include <cmath>
#include <optional>

#include <Eigen/LU>

#include "model/spring_rows.hpp"

namespace springlod::elastic {
namespace {

/// Three unit vectors count as coplanar if their determinant is smaller than this. Several
/// directions u count as coplanar if the determinant of sum u u^T is smaller than its square. Any
/// value above rounding errors is valid: a node near the threshold is left out of the cluster, and
/// its motion is solved for.
constexpr double kFlat = 1e-3;

class Growth {
 public:
  explicit Growth(const MassSpringModel& model)
      : model_(model),
        springs_(model),
        clusters_{std::vector<std::uint32_t>(model.node_count(), kNoCluster), 0},
        touching_(model.node_count()) {}

  RigidClusters run() {
    for (std::uint32_t i = 0; i < model_.node_count(); ++i) {
      if (!is_free(i)) continue;
      if (const auto seed = tetrahedron_at(i)) grow(*seed);
    }
    return clusters_;
  }

 private:
  /// Directions of the springs of a node to the growing cluster.
  struct Touching {
    std::uint32_t cluster = kNoCluster;
    Mat3 directions = Mat3::Zero();  // sum of u u^T
  };

  bool is_free(std::uint32_t i) const { return clusters_.of_node[i] == kNoCluster; }

  bool solid(const std::array<std::uint32_t, 4>& t) const {
    Mat3 edges;
    for (int d = 0; d < 3; ++d)
      edges.col(d) =
          (model_.rest[t[static_cast<std::size_t>(d) + 1]] - model_.rest[t[0]]).normalized();
    return std::abs(edges.determinant()) > kFlat;
  }

  /// Four free nodes, not coplanar, with i the lowest; springs connect every pair.
  std::optional<std::array<std::uint32_t, 4>> tetrahedron_at(std::uint32_t i) const {
    std::vector<std::uint32_t> around;
    springs_.for_each(i, [&](std::uint32_t j, std::uint32_t) {
      if (j > i && is_free(j)) around.push_back(j);
    });
    for (std::size_t j = 0; j < around.size(); ++j)
      for (std::size_t k = j + 1; k < around.size(); ++k) {
        if (!springs_.joined(around[j], around[k])) continue;
        for (std::size_t l = k + 1; l < around.size(); ++l) {
          if (!springs_.joined(around[j], around[l]) || !springs_.joined(around[k], around[l]))
            continue;
          const std::array<std::uint32_t, 4> found{i, around[j], around[k], around[l]};
          if (solid(found)) return found;
        }
      }
    return std::nullopt;
  }

  void grow(const std::array<std::uint32_t, 4>& seed) {
    const std::uint32_t cluster = clusters_.count++;
    std::vector<std::uint32_t> fresh(seed.begin(), seed.end());
    for (const std::uint32_t i : seed) clusters_.of_node[i] = cluster;
    while (!fresh.empty()) {
      const std::uint32_t i = fresh.back();
      fresh.pop_back();
      springs_.for_each(i, [&](std::uint32_t j, std::uint32_t s) {
        if (!is_free(j)) return;
        Touching& touching = touching_[j];
        if (touching.cluster != cluster) touching = {cluster, Mat3::Zero()};
        const Vec3 u = spring_direction(model_, s);
        touching.directions += u * u.transpose();
        if (touching.directions.determinant() <= kFlat * kFlat) return;
        clusters_.of_node[j] = cluster;
        fresh.push_back(j);
      });
    }
  }

  const MassSpringModel& model_;
  SpringRows springs_;
  RigidClusters clusters_;
  std::vector<Touching> touching_;
};

}  // namespace

RigidClusters rigid_clusters(const MassSpringModel& model) {
  return Growth(model).run();
}

}  // namespace springlod::elastic
