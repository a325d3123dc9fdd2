#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/progress.hpp"
#include "model/mass_spring.hpp"

namespace springlod::elastic {

class SparseCholesky;

/// One connected part of a model, ready to be solved with: n nodes that can move, 3n unknowns
/// y = M^1/2 u, in which the stiffness is D = M^-1/2 K M^-1/2 [1/s2] and modes are orthonormal.
/// Springs to anchored nodes count in K; the anchored nodes themselves have no unknowns.
struct ElasticPart {
  std::vector<std::uint32_t> nodes;       ///< n, rising
  Eigen::VectorXd root_mass;              ///< sqrt(m) of each unknown [kg^1/2], 3n
  Eigen::SparseMatrix<double> stiffness;  ///< D, 3n x 3n, both halves
  /// 3n x z, orthonormal: rigid motions and mechanisms. z = 0 where anchors leave neither.
  Eigen::MatrixXd zero_modes;
  double shift = 0;                              ///< sigma [1/s2] > 0
  std::shared_ptr<const SparseCholesky> factor;  ///< of D + sigma I

  Eigen::Index unknowns() const { return root_mass.size(); }
  /// Takes the zero modes out of each column of y.
  void remove_zero_modes(Eigen::MatrixXd& y) const;
  /// (D + sigma I)^-1 b without zero modes, for each column of b.
  Eigen::MatrixXd solve_shifted(const Eigen::MatrixXd& b) const;
  /// The 3n numbers of this part's nodes, out of N vectors of the model.
  Eigen::VectorXd gather(const std::vector<Vec3>& of_model) const;
  /// The other way; leaves the nodes of other parts alone.
  void scatter(const Eigen::VectorXd& of_part, std::vector<Vec3>& of_model) const;
};

/// A model factorised once for all that is asked about its elasticity: modes, static loads.
/// Treat as immutable.
struct ElasticBody {
  std::uint32_t node_count = 0;
  std::vector<std::uint32_t> anchored;  ///< rising, each once; empty: nothing holds the body
  std::vector<ElasticPart> parts;       ///< by their lowest node; those that can move
  std::uint32_t zero_mode_count() const;
};

struct ElasticOptions {
  /// Nodes held where they are, in any order: what is solved for then is the body fixed there. On
  /// a level, `carried` takes those of level 0 along.
  std::vector<std::uint32_t> anchored = {};
  Progress* progress = nullptr;  ///< may be null
};

/// Finds the zero modes of each part and factorises it with a small shift: 1e-12 of the square
/// of the largest frequency, which the bends of a bar a hundred times as long as thick still exceed
/// a hundred times.
///
/// 20k nodes as a cube: 4 s and 0.7 GB; time goes with N^2, storage with N^4/3.
/// Throws InputError for places, masses or stiffnesses that are not finite or masses not above 0,
/// for a model with more mechanisms than can be stored (hundreds, in a large
/// part), for stiffnesses so uneven that no small shift makes the matrix positive, and for anchored
/// nodes that the model does not have. Anchors that leave motions free are no error here: those
/// are zero modes, which solve_static refuses to push at.
ElasticBody elastic_body(const MassSpringModel& model, const ElasticOptions& options = {});

}  // namespace springlod::elastic
