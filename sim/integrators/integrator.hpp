#pragma once

#include <array>
#include <cstdint>

namespace springlod {

/// How a run goes from one step to the next.
enum class Integrator {
  symplectic_euler,       ///< explicit; first order in damping
  velocity_verlet,        ///< explicit; second order, limit of twice the damping time
  runge_kutta_4,          ///< explicit, classical; four force evaluations a step
  backward_euler_cg,      ///< implicit; Newton's systems by conjugate gradients
  backward_euler_direct,  ///< implicit; Newton's systems by sparse factorization
  xpbd,                   ///< extended position based dynamics (Macklin, Mueller, Chentanez 2016)
  projective_dynamics,    ///< Bouaziz, Martin, Liu, Kavan, Pauly 2014
};

inline constexpr std::array kIntegrators{
    Integrator::symplectic_euler,   Integrator::velocity_verlet,       Integrator::runge_kutta_4,
    Integrator::backward_euler_cg,  Integrator::backward_euler_direct, Integrator::xpbd,
    Integrator::projective_dynamics};

/// The word that scripts and tables use: "symplectic_euler".
const char* to_string(Integrator integrator);

/// Whether the step is not bound by the model's highest frequency.
bool is_implicit(Integrator integrator);

/// For the schemes that iterate.
struct SolverOptions {
  /// Newton iterations at most (backward Euler), sweeps over all springs (XPBD), local-global
  /// iterations (projective dynamics); 0: 20, 1 (small steps rather than sweeps: Macklin et al.
  /// 2019) and 10.
  std::uint32_t iterations = 0;
  /// Backward Euler stops once the forces left are this part of those at the start of the step [1].
  double tolerance = 1e-6;
  /// Iterations of the conjugate gradients inside one of Newton's at most; 0: twice the unknowns.
  std::uint32_t linear_iterations = 0;
};

/// Iterations at most that `options` stand for: their default filled in; 0 for the explicit
/// schemes.
std::uint32_t iterations_of(Integrator integrator, const SolverOptions& options);

}  // namespace springlod
