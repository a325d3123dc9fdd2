#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "elastic/elastic_body.hpp"
#include "elastic/loads.hpp"
#include "elastic/modes.hpp"
#include "lod/calibration/elastic_targets.hpp"
#include "lod/calibration/modal_loads.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Weighted residuals r of a level against its targets, with the solutions that they follow from
/// (docs/method.md, eqs. 30 to 34).
struct ElasticResiduals {
  Eigen::VectorXd weighted;              ///< r, R [1]
  std::vector<double> frequency_error;   ///< |omega / omega0 - 1| of each mode, unweighted [1]
  std::vector<double> compliance_error;  ///< the same of each load
  std::vector<elastic::Mode> modes;
  std::vector<elastic::StaticSolution> loads, shapes;  ///< shapes: under the modal loads
  /// Rigid accelerations under the loads and the modal loads, N each [m/s2]; with NodeMasses::free.
  std::vector<std::vector<Vec3>> load_acceleration, shape_acceleration;
};

/// Evaluates the residuals of one level for any stiffnesses and masses; positions and springs are
/// fixed. The level must be connected.
class ElasticFit {
 public:
  /// `level` has the masses of its groups. With two threads or more, modes and loads are solved
  /// concurrently.
  ElasticFit(const MassSpringModel& level, const Groups& of_base, const ElasticTargets& targets,
             const FitOptions& options = {});

  /// Modes are matched in ascending order of lambda = omega^2.
  ElasticResiduals residuals(const MassSpringModel& level) const;

  /// Sets G = -dr / d(ln k, ln |T|, ln m), S + T rows, or S + T + N with NodeMasses::free, by R
  /// [1]; its memory is used again. For dilatation terms, T and their gradients take the places of
  /// k and b. The derivatives are
  ///   d ln lambda / d ln k = k (b.phi)^2 / lambda,   d ln lambda / d ln m = -m |phi|^2,
  ///   d ln c / d ln k = -k (b.u)^2 / c,              d ln c / d ln m = -2 m u.a / c,
  /// with the compliance c = f.u of a load f and the rigid acceleration a of the free body under f.
  /// Modes of nearly equal frequency (lambda within 1 %) are not differentiable one by one. Each
  /// pair of them adds a row with residual 0, which keeps the two modes from mixing.
  ///
  /// Shapes are compared by the compliances C_ij = f_j . u_i of each pair of modal loads, which are
  /// differentiable for modes of equal frequency too:
  ///   dC_ij / d ln k = -k (b.u_i)(b.u_j),   dC_ij / d ln m = -m (u_i.a_j + u_j.a_i).
  void jacobian(const MassSpringModel& level, const ElasticResiduals& of_level,
                Eigen::MatrixXd& into) const;

 private:
  /// Pairs (i, j >= i) of modes of nearly equal frequency; each mode is paired with itself.
  std::vector<std::pair<std::size_t, std::size_t>> mode_pairs() const;
  /// First row of each kind; `end`: R.
  struct Rows {
    Eigen::Index loads = 0, shapes = 0, end = 0;
  };
  Rows rows() const;
  /// Fill the residuals of modes, loads or shapes.
  void solve_modes(const elastic::ElasticBody& body, ElasticResiduals& all) const;
  void solve_loads(const elastic::ElasticBody& body, ElasticResiduals& all) const;
  void solve_shapes(const elastic::ElasticBody& body, ElasticResiduals& all) const;
  /// Fill their rows of the Jacobian.
  void add_modes(const MassSpringModel& level, const ElasticResiduals& of_level,
                 Eigen::MatrixXd& into) const;
  void add_loads(const MassSpringModel& level, const ElasticResiduals& of_level,
                 Eigen::MatrixXd& into) const;
  void add_shapes(const MassSpringModel& level, const ElasticResiduals& of_level,
                  Eigen::MatrixXd& into) const;
  double shape_weight(std::size_t i, std::size_t j) const;

  const ElasticTargets& targets_;
  std::uint32_t threads_;
  bool free_masses_;
  Support anchored_;  // of the level
  std::vector<elastic::StaticLoad> loads_;
  ModalLoads modal_;
  // (S + T) x 3N: b of each spring, and of each term.
  Eigen::SparseMatrix<double, Eigen::RowMajor> stretch_;
};

}  // namespace springlod::lod
