#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Stiffness matrix at rest, 3N x 3N [N/m]; node i has the rows 3i..3i+2 (docs/method.md, eq. 11).
/// Symmetric; both triangles are stored.
Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model);

/// f = K u without assembling K: N displacements u [m], N forces f [N].
void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f);

/// Result of a stretch test along `axis` (0 x, 1 y, 2 z). The ends are displaced along the axis and
/// free to contract; Young's modulus follows from the reaction over the cross-section, Poisson's
/// ratio from the contraction of the middle half.
///
/// The ends are the nodes within half a mean spring length of the extreme nodes: one plane of nodes
/// in a lattice. A node of an end has the displacement of uniform strain along the axis. In merged
/// and random models, whose ends are not planar, this prescribes uniform strain in the layer at
/// either end (slightly too stiff); one common displacement would not strain the layer at all.
struct StretchResult {
  double young = 0;  ///< [Pa]
  /// Least squares over the middle half of the length, mean of both lateral directions; NaN if the
  /// nodes there have no width.
  double poisson = 0;
  double reaction = 0;       ///< [N] at strain 1 (linear theory)
  double strain_energy = 0;  ///< [J] at strain 1 (linear theory)
};
struct StretchOptions {
  int axis = 2;
  /// Cross-section [m2]; 0: volume of the model / distance between its extreme nodes. Needed for
  /// models whose nodes do not reach the ends of the body (`centers` lattices, merged models).
  double cross_section = 0;
};
/// Stretch test by conjugate gradients. Motions that no spring resists (lateral rigid motions,
/// mechanisms) do not enter the solution. Throws InputError for a model with fewer than two planes
/// of nodes along the axis, and if the iteration does not converge.
StretchResult stretch_test(const MassSpringModel& model, const StretchOptions& options = {});

}  // namespace springlod::elastic
