#pragma once

#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

// The energy of springs and dilatation terms at any positions, and its derivatives.
namespace springlod::elastic {

/// [J]
double strain_energy(const MassSpringModel& model, const std::vector<Vec3>& x);

/// Its derivative by the positions: N forces that hold the nodes there [N].
std::vector<Vec3> holding_forces(const MassSpringModel& model, const std::vector<Vec3>& x);

/// Which second derivatives a tangent matrix contains.
enum class Tangent {
  exact,
  /// Without the negative part of springs that are compressed, and without the curvature of
  /// dilatation terms. Positive semidefinite if no term has a negative modulus.
  convex,
};

/// Its second derivatives, 3N x 3N [N/m], laid out as stiffness_matrix; the same as that at rest.
Eigen::SparseMatrix<double> tangent_matrix(const MassSpringModel& model, const std::vector<Vec3>& x,
                                           Tangent tangent);

}  // namespace springlod::elastic
