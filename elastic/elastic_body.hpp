#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "base/progress.hpp"
#include "model/anchors.hpp"
#include "model/mass_spring.hpp"

namespace springlod::elastic {

class SparseCholesky;

/// A factorised connected component of a model: n free nodes and 3n unknowns y = M^1/2 u. In these
/// unknowns the stiffness is D = M^-1/2 K M^-1/2 [1/s2], and modes are orthonormal. K includes the
/// springs to anchored nodes and those of the support; anchored nodes have no unknowns.
struct ElasticComponent {
  std::vector<std::uint32_t> nodes;       ///< n, ascending
  Eigen::VectorXd root_mass;              ///< sqrt(m) of each unknown [kg^1/2], 3n
  Eigen::SparseMatrix<double> stiffness;  ///< D, 3n x 3n, both triangles
  /// 3n x z, orthonormal: rigid motions and mechanisms. z = 0 if the anchors leave none.
  Eigen::MatrixXd zero_modes;
  double shift = 0;                              ///< sigma [1/s2] > 0
  std::shared_ptr<const SparseCholesky> factor;  ///< of D + sigma I

  Eigen::Index unknowns() const { return root_mass.size(); }
  /// Projects the zero modes out of each column of y.
  void remove_zero_modes(Eigen::MatrixXd& y) const;
  /// (D + sigma I)^-1 b without zero modes, for each column of b (docs/method.md, eq. 13).
  Eigen::MatrixXd solve_shifted(const Eigen::MatrixXd& b) const;
  /// The 3n values of this component's nodes, from N vectors of the model.
  Eigen::VectorXd gather(const std::vector<Vec3>& of_model) const;
  /// The inverse of gather(); the entries of other components are unchanged.
  void scatter(const Eigen::VectorXd& of_component, std::vector<Vec3>& of_model) const;
};

/// A model factorised once for several analyses: modes and static loads. Treat it as immutable.
struct ElasticBody {
  std::uint32_t node_count = 0;
  Support anchored;  ///< its nodes ascending, each once; empty: the body is free
  std::vector<ElasticComponent> components;  ///< by their lowest node; those with a free node
  std::uint32_t zero_mode_count() const;
};

struct ElasticOptions {
  /// What holds the body; `mapped_support` maps that of level 0 to a level.
  Support anchored = {};
  Progress* progress = nullptr;  ///< may be null
};

/// Finds the zero modes of each connected component and factorises it with a small shift: 1e-12 of
/// the square of the largest frequency (docs/method.md, eq. 13). The lowest squared bending
/// frequency of a bar a hundred times as long as thick is still a hundred times the shift.
///
/// Cost of a cube of 20k nodes: 4 s and 0.7 GB; the time grows with N^2, the memory with N^4/3.
///
/// Throws InputError: positions, masses or stiffnesses that are not finite, masses that are not
/// above 0, more mechanisms than can be stored (hundreds, in a large component), stiffnesses so
/// uneven that no small shift makes the matrix positive definite, a support that does not fit the
/// model. Anchors that leave motions free are no error here: such motions are zero modes,
/// and solve_static rejects loads on them.
ElasticBody elastic_body(const MassSpringModel& model, const ElasticOptions& options = {});

}  // namespace springlod::elastic
