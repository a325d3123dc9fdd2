#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "model/mass_spring.hpp"

namespace springlod::lod {

/// By how much nodes are stiffer than a limit allows, b_i = ln(2 |A_i| / (m_i tau)),
/// A_i = sum_j k_ij u u^T, and the slopes of b by ln k and ln m: for each node only those of its
/// own springs and mass. 2 max_i lambda_max(A_i) / m_i bounds omega^2 from above (spec 5).
///
/// |A| is the Schatten norm (tr A^32)^(1/32), at most 1.04 lambda_max and at least lambda_max:
/// lambda_max itself has a kink where two eigenvalues meet, which is where lowering it leads.
struct FrequencyConstraints {
  Eigen::VectorXd value;  ///< b, L: of nodes near or above the limit
  Eigen::SparseMatrix<double, Eigen::RowMajor> jacobian;  ///< L x (S + N)
};

/// Rows of the nodes with b > -`margin`; tau [rad2/s2].
FrequencyConstraints frequency_constraints(const MassSpringModel& model, double tau, double margin);

/// Largest 2 |A_i| / m_i [rad2/s2].
double largest_node_bound(const MassSpringModel& model);

/// Sum of the squares of the b above 0.
double squared_violation(const MassSpringModel& model, double tau);

}  // namespace springlod::lod
