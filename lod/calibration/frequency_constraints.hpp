#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "lod/options.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Constraints h_i = ln(2 |A_i| / (m_i tau)) <= 0 on the frequencies of the nodes and their
/// Jacobian by ln k, ln |T| and, with free masses, ln m, with A_i of bounding_node_stiffness: sum_j
/// k_ij u u^T over the springs of node i without dilatation terms (docs/method.md, eqs. 37 and 38).
/// They bound the highest frequency: omega_max^2 <= 2 max_i lambda_max(A_i) / m_i (eq. 15).
///
/// |A| is the Schatten norm (tr A^32)^(1/32), between lambda_max and 1.04 lambda_max. It is smooth
/// where two eigenvalues coincide, as they do once the largest one has been lowered; lambda_max is
/// not.
struct FrequencyConstraints {
  Eigen::VectorXd value;  ///< h, L [1]
  /// H, L x (S + T) or, with NodeMasses::free, L x (S + T + N) [1]
  Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian;
};

/// Constraints of the nodes with h_i > -`margin`; tau is the bound on omega^2 [rad2/s2].
FrequencyConstraints frequency_constraints(const MassSpringModel& model, double tau, double margin,
                                           NodeMasses masses);

/// Largest node bound, max_i 2 |A_i| / m_i [rad2/s2].
double largest_node_bound(const MassSpringModel& model);

/// Sum of max(0, h_i)^2 [1].
double squared_violation(const MassSpringModel& model, double tau);

}  // namespace springlod::lod
