#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <utility>

#include "base/choice.hpp"
#include "base/option.hpp"
#include "model/mass_spring.hpp"

namespace springlod::sim {

struct RunOptions;
struct RunPlan;
struct Scenario;
class Stepper;

/// Time integration scheme of a run. Its row in the table describes it: see choices(Integrator).
enum class Integrator {
  symplectic_euler,
  velocity_verlet,
  runge_kutta_4,
  backward_euler_cg,
  backward_euler_direct,
  xpbd,
  projective_dynamics,
};

/// A row of the table of integrators.
struct IntegratorChoice : Choice<Integrator> {
  /// The stepper for steps of `step` [s]. Model, scenario and the plan's layout must outlive it.
  std::unique_ptr<Stepper> (*make)(const MassSpringModel& model, const Scenario& scenario,
                                   const State& start, double step, const RunOptions& options,
                                   const RunPlan& plan);
  struct Traits {
    /// Largest stable step [s] for frequencies up to omega_max [rad/s] and one damping time [s].
    /// Null: implicit; the model's highest frequency does not limit the step.
    double (*stable_step)(double omega_max, double damping_time) = nullptr;
    std::uint32_t iterations = 0;  ///< default of the maximum; 0: does not iterate
    /// Takes a fixed number of cheap iterations, without a tolerance.
    bool swept = false;
    /// Uses the kernels of sim/fast: has a layout and a precision, and may change its step.
    bool fast = false;
    /// Two header lines of its column in a stability map; for schemes with a fixed number of
    /// iterations, the second names one iteration.
    const char* heading[2] = {"", ""};
  } traits;
};
ChoiceTable<IntegratorChoice> choices(Integrator);
/// What scripts can read about an integrator.
constexpr auto choice_traits(const IntegratorChoice& row) {
  return std::array{std::pair("implicit", row.traits.stable_step == nullptr),
                    std::pair("swept", row.traits.swept), std::pair("fast", row.traits.fast)};
}

/// True if the model's highest frequency does not limit the step.
bool is_implicit(Integrator integrator);

/// Options of the iterative schemes.
struct SolverOptions {
  /// Largest number of Newton iterations (backward Euler), sweeps over all springs (XPBD),
  /// local-global iterations (projective dynamics); 0: those of the integrator's row.
  std::uint32_t iterations = 0;
  /// Backward Euler stops when the residual forces are at most this fraction of the acting forces
  /// [1]: of the larger of the first residual and m (|v| / dt + |g|).
  double tolerance = 1e-6;
  /// Largest number of conjugate gradient iterations in one Newton iteration; 0: twice the number
  /// of unknowns.
  std::uint32_t linear_iterations = 0;
};
constexpr auto option_rows(const SolverOptions*) {
  return std::tuple(
      option("iterations", &SolverOptions::iterations,
             "iterations per step of the implicit schemes")
          .within(1, 10000)
          .by_default("20 for backward Euler, 1 for xpbd, 10 for projective_dynamics"),
      option("tolerance", &SolverOptions::tolerance,
             "relative residual of the forces at which backward Euler stops iterating")
          .within(1e-15, 0.5),
      option("linear_iterations", &SolverOptions::linear_iterations,
             "largest number of conjugate-gradient iterations in one Newton iteration")
          .within(1, 1e6)
          .by_default("twice the unknowns"));
}

/// Largest number of iterations under `options`, after filling in the default; 0 for the explicit
/// schemes.
std::uint32_t iterations_of(Integrator integrator, const SolverOptions& options);

}  // namespace springlod::sim
