#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Stiffness matrix at rest, 3N x 3N, node i at rows 3i..3i+2 [N/m]; symmetric, both halves stored.
Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model);

/// f = K u without assembling K; u and f are N displacements [m] and forces [N].
void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f);

/// Young's modulus and Poisson's ratio that a bar shows in a stretch test along `axis` (0 x, 1 y,
/// 2 z): the ends are pulled apart, free to contract sideways; E from the reaction over the
/// cross-section, nu from the contraction of the middle half.
///
/// The ends are the nodes within half a mean spring length of the extremes: a plane of nodes in a
/// lattice. A node of an end moves along the axis as uniform strain would have it. In merged and
/// random models, whose ends are no planes, that holds the layer at either end to uniform strain
/// along the axis (a little too stiff), where a common displacement would not strain it at all.
struct StretchResult {
  double young = 0;  ///< [Pa]
  /// Least squares over the middle half of the length, the mean of both directions across; NaN if
  /// there the nodes have no width to contract.
  double poisson = 0;
  double reaction = 0;       ///< [N] at strain 1 (linear)
  double strain_energy = 0;  ///< [J] at strain 1 (linear)
};
struct StretchOptions {
  int axis = 2;
  /// Cross-section [m2]; 0: volume of the model over the distance between its extreme nodes. Give
  /// it for models whose nodes do not reach the ends of the body (`centers` lattices, merged
  /// models).
  double cross_section = 0;
};
/// Conjugate gradients; motions that no spring resists (rigid ones across, mechanisms) stay out of
/// the solution by themselves. Throws InputError for a model with fewer than two planes of nodes
/// along the axis, and should the iteration not converge.
StretchResult stretch_test(const MassSpringModel& model, const StretchOptions& options = {});

}  // namespace springlod::elastic
