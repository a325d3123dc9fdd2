#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

struct FrequencyOptions {
  /// Extra stiffness to ground of each node (contact) [N/m]; empty or N.
  std::vector<double> ground_stiffness;
  std::uint64_t seed = 1;  ///< of the start vector
};
/// Largest angular frequency of the model about rest [rad/s], from above by less than 1 part in
/// 1e4: the converged Ritz value plus its residual. Lanczos iteration (Spectra) on M^-1/2 K M^-1/2
/// without assembling it; small models by a dense solver. Never above `frequency_bound`, which it
/// falls back to should Lanczos not converge. 0 for a model without springs and ground stiffness.
/// Throws InputError for a ground stiffness of another size than N.
double largest_frequency(const MassSpringModel& model, const FrequencyOptions& options = {});

/// Bound without iterating: omega^2 <= 2 max_i lambda_max(A_i) / m_i, A_i = sum_j k_ij u u^T
/// [rad/s].
double frequency_bound(const MassSpringModel& model);
/// A_i of each node [N/m], N: what the node feels of its springs while its neighbours rest.
std::vector<Mat3> node_stiffness(const MassSpringModel& model);
/// What each node adds to that bound where springs are turned, stretched and compressed, nodes at
/// x: (2 lambda + ground_i) / m_i [rad2/s2], N, with
/// A_i = sum_j k_ij (u u^T + max(0, 1 - L/l) (1 - u u^T)): a stretched spring is stiff across, too.
/// lambda = q + 2p >= lambda_max(A_i), where q is the mean of its eigenvalues and 6 p^2 the sum of
/// their squared distances from it (exact for one large and two equal ones); quick, and the same
/// however the body is turned.
/// `ground_stiffness` as in FrequencyOptions.
std::vector<double> node_frequency_bounds(const MassSpringModel& model, const std::vector<Vec3>& x,
                                          const std::vector<double>& ground_stiffness);

/// Largest damping time c/k of the springs [s].
double largest_damping_time(const MassSpringModel& model);

/// Largest stable step of explicit symplectic Euler with damping evaluated at the old velocity:
/// dt = -beta + sqrt(beta^2 + 4 / omega_max^2) [s]; exact for one beta = c/k, safe for the largest.
/// Infinite for omega_max = 0.
double stable_step(double omega_max, double damping_time);
double stable_step(const MassSpringModel& model);

}  // namespace springlod::elastic
