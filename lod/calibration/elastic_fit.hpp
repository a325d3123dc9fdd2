#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "elastic/elastic_body.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// How a level misses its targets: weighted misses r and their slopes by ln k of each spring and
/// ln m of each node.
struct ElasticResiduals {
  Eigen::VectorXd weighted;             ///< r, R [1]
  Eigen::MatrixXd jacobian;             ///< (S + N) x R: by how much each unknown lessens each miss
  std::vector<double> frequency_error;  ///< |found / wanted - 1| of each mode, not weighted
  std::vector<double> compliance_error;  ///< the same of each load
};

/// Compares a level with the targets of its base, as often as its stiffnesses and masses change;
/// nodes and springs stay. The level must be one connected part.
class ElasticFit {
 public:
  /// On two of the threads, if there are, modes and loads are found side by side.
  ElasticFit(const MassSpringModel& level, const Groups& of_base, const ElasticTargets& targets,
             std::uint32_t threads = 1);

  /// Squared frequencies in the order of their size, lambda = omega^2:
  ///   d ln lambda / d ln k = k (b.phi)^2 / lambda,   d ln lambda / d ln m = -m |phi|^2,
  /// and of modes whose frequencies the base has within 1 % of each other also that the level's
  /// should not mix as they change, phi_i^T (dK - lambda dM) phi_j = 0: near-double modes are not
  /// differentiable one by one. Compliances:
  ///   d ln c / d ln k = -k (b.u)^2 / c,   d ln c / d ln m = -2 m u.a / c,
  /// a the acceleration of the free body, whose inertia balances the load.
  ElasticResiduals residuals(const MassSpringModel& level) const;

 private:
  /// Pairs of modes, each with itself and those of its own frequency.
  std::vector<std::pair<std::size_t, std::size_t>> mode_pairs() const;
  /// Fill the rows from `first` on.
  void add_modes(const MassSpringModel& level, const elastic::ElasticBody& body, Eigen::Index first,
                 ElasticResiduals& all) const;
  void add_loads(const MassSpringModel& level, const elastic::ElasticBody& body, Eigen::Index first,
                 ElasticResiduals& all) const;

  const ElasticTargets& targets_;
  std::uint32_t threads_;
  std::vector<std::uint32_t> anchored_;
  std::vector<elastic::StaticLoad> loads_;
  Eigen::SparseMatrix<double, Eigen::RowMajor> stretch_;  // S x 3N: b of each spring
};

}  // namespace springlod::lod
