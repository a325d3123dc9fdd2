#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Largest angular frequency of the model about rest [rad/s]: the converged Ritz value plus its
/// residual, an upper bound that is at most 1e-4 too large. Lanczos iteration (Spectra) on M^-1/2 K
/// M^-1/2 without assembling it; a dense solver for small models. It never exceeds
/// `frequency_bound`, which is returned if Lanczos does not converge. 0 for a model without
/// springs. `seed`: of the start vector. `held`: nodes that do not move; holding more never raises
/// the frequency.
double largest_frequency(const MassSpringModel& model, std::uint64_t seed = 1,
                         std::span<const std::uint32_t> held = {});

/// Upper bound of the largest angular frequency without iterating [rad/s]: omega^2 <= 2 max_i
/// lambda_max(A_i) / m_i, with the bounding stiffness A_i of each node (docs/method.md, eq. 15).
double frequency_bound(const MassSpringModel& model);
/// Stiffness of each node while all others are held [N/m], N: sum_j k_ij u u^T, and T b b^T of its
/// dilatation terms.
std::vector<Mat3> node_stiffness(const MassSpringModel& model);
/// A_i of frequency_bound [N/m], N: sum_j k_ij u u^T, and bounding_share of its dilatation terms
/// with T > 0; without terms, node_stiffness.
std::vector<Mat3> bounding_node_stiffness(const MassSpringModel& model);
/// What a term adds to A_i of a node for T = 1 J [1/m2]: B b_i b_i^T / (2 |b_i|), with the sum B of
/// all |b_j| (sum_of_norms). By Cauchy's inequality, (sum_j b_j.u_j)^2 <= B sum_i (b_i.u_i)^2 /
/// |b_i|.
Mat3 bounding_share(double sum_of_norms, const Vec3& gradient);
double sum_of_norms(std::span<const Vec3> gradients);
/// Contribution of each node to that bound in a deformed state x: 2 lambda / m_i
/// [rad2/s2], N, with A_i = sum_j k_ij (u u^T + max(0, 1 - L/l) (1 - u u^T)): a stretched spring is
/// stiff across its direction, too (docs/method.md, eqs. 15 and 16). Dilatation terms add
/// bounding_share with the derivatives of eps in that state, and a bound on their geometric
/// stiffness (eq. 16a).
///
/// lambda = q + 2p >= lambda_max(A_i), where q is the mean of the eigenvalues and 6 p^2 the sum of
/// their squared deviations from it. It is exact for one large and two equal eigenvalues, cheap,
/// and invariant under rotations.
std::vector<double> node_frequency_bounds(const MassSpringModel& model, const std::vector<Vec3>& x);

/// The same for the nodes at a spring with |l - L| / L > `strain` in the state x; 0 for the others.
/// Most of a body is rarely strained, and then costs little.
std::vector<double> strained_frequency_bounds(const MassSpringModel& model,
                                              const std::vector<Vec3>& x, double strain);

/// Largest damping time of the springs, c/k, and of the dilatation terms [s].
double largest_damping_time(const MassSpringModel& model);

/// Largest stable time step of explicit symplectic Euler with damping evaluated at the old velocity
/// [s]: dt = -beta + sqrt(beta^2 + 4 / omega_max^2) (docs/method.md, eq. 56). Exact if all springs
/// have one beta = c/k, and stable with the largest one. Infinite for omega_max = 0.
double stable_step(double omega_max, double damping_time);
double stable_step(const MassSpringModel& model);

}  // namespace springlod::elastic
