#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

namespace springlod {

/// Stiffness matrix at rest, 3N x 3N, node i at rows 3i..3i+2 [N/m]; symmetric, both halves stored.
Eigen::SparseMatrix<double> stiffness_matrix(const MassSpringModel& model);

/// f = K u without assembling K; u and f are N displacements [m] and forces [N].
void apply_stiffness(const MassSpringModel& model, const std::vector<Vec3>& u,
                     std::vector<Vec3>& f);

/// Young's modulus and Poisson's ratio that a bar shows in a stretch test along `axis` (0 x, 1 y,
/// 2 z): the end planes are pulled apart, free to contract sideways; E from the reaction over the
/// true cross-section, nu from the contraction of the middle half.
struct StretchResult {
  double young = 0;  ///< [Pa]
  double poisson = 0;
  double reaction = 0;  ///< [N] at strain 1 (linear)
  double strain_energy = 0;
};
struct StretchOptions {
  int axis = 2;
  /// Cross-section [m2]; 0: volume of the model over its length along the axis.
  double cross_section = 0;
};
/// Throws InputError for a model with fewer than two planes of nodes along the axis.
StretchResult stretch_test(const MassSpringModel& model, const StretchOptions& options = {});

}  // namespace springlod
