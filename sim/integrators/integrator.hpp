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

/// How a run goes from one step to the next; what each is stands in its row, see
/// choices(Integrator).
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
    /// Null: implicit, the step is not bound by the model's highest frequency.
    double (*stable_step)(double omega_max, double damping_time) = nullptr;
    std::uint32_t iterations = 0;  ///< at most, unless others are asked for; 0: does not iterate
    /// Takes a fixed number of cheap iterations and promises no tolerance.
    bool swept = false;
    /// Moved by the kernels of sim/fast: has a layout and a precision, and may change its step.
    bool fast = false;
    /// Two lines above a column of a stability map; of swept schemes the second names one
    /// iteration.
    const char* heading[2] = {"", ""};
  } traits;
};
ChoiceTable<IntegratorChoice> choices(Integrator);
/// What scripts may ask of an integrator.
constexpr auto choice_traits(const IntegratorChoice& row) {
  return std::array{std::pair("implicit", row.traits.stable_step == nullptr),
                    std::pair("swept", row.traits.swept), std::pair("fast", row.traits.fast)};
}

/// Whether the step is not bound by the model's highest frequency.
bool is_implicit(Integrator integrator);

/// For the schemes that iterate.
struct SolverOptions {
  /// Newton iterations at most (backward Euler), sweeps over all springs (XPBD), local-global
  /// iterations (projective dynamics); 0: those of the integrator's row.
  std::uint32_t iterations = 0;
  /// Backward Euler stops once the forces left are this part of those at the start of the step [1].
  double tolerance = 1e-6;
  /// Iterations of the conjugate gradients inside one of Newton's at most; 0: twice the unknowns.
  std::uint32_t linear_iterations = 0;
};
constexpr auto option_rows(const SolverOptions*) {
  return std::tuple(
      option("iterations", &SolverOptions::iterations,
             "iterations per step of the implicit schemes")
          .by_default("20 of Newton, 1 sweep of xpbd, 10 of projective_dynamics"),
      option("tolerance", &SolverOptions::tolerance,
             "part of the forces at which backward Euler stops iterating"),
      option("linear_iterations", &SolverOptions::linear_iterations,
             "largest number of conjugate-gradient iterations in one Newton iteration")
          .by_default("twice the unknowns"));
}

/// Iterations at most that `options` stand for: their default filled in; 0 for the explicit
/// schemes.
std::uint32_t iterations_of(Integrator integrator, const SolverOptions& options);

}  // namespace springlod::sim
