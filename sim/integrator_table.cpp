// All integrators. To add one: write a file with its stepper, an enumerator and a row here.

#include "elastic/stable_step.hpp"
#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/backward_euler.hpp"
#include "sim/integrators/integrator.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/projective_dynamics.hpp"
#include "sim/integrators/runge_kutta.hpp"
#include "sim/integrators/xpbd.hpp"
#include "sim/run.hpp"

namespace springlod::sim {
namespace {

constexpr std::uint32_t kNewtonIterations = 20;  // Newton's method rarely needs more than 5
constexpr std::uint32_t kSweeps = 1;  // small steps rather than sweeps (Macklin et al. 2019)
constexpr std::uint32_t kLocalGlobalIterations = 10;

std::unique_ptr<Stepper> make_fast(const MassSpringModel& model, const Scenario& scenario,
                                   const State& start, double step, const RunOptions& options,
                                   const RunPlan& plan) {
  return std::make_unique<FastLeapfrog>(model, scenario, start, step,
                                        FastOptions{.ledger = options.ledger,
                                                    .volumes = options.volumes,
                                                    .precision = options.precision,
                                                    .threads = options.threads,
                                                    .layout = plan.layout,
                                                    .skin = options.skin,
                                                    .anchors = options.anchors});
}

template <class Scheme>
std::unique_ptr<Stepper> make(const MassSpringModel& model, const Scenario& scenario,
                              const State& start, double step, const RunOptions& options,
                              const RunPlan& /*plan*/) {
  return std::make_unique<Scheme>(model, scenario, start, step,
                                  StepperOptions{.integrator = options.integrator,
                                                 .solver = options.solver,
                                                 .ledger = options.ledger,
                                                 .volumes = options.volumes,
                                                 .skin = options.skin,
                                                 .anchors = options.anchors});
}

/// See Leapfrog.
double verlet_stable_step(double omega_max, double damping_time) {
  return elastic::stable_step(omega_max, 2 * damping_time);
}

constexpr IntegratorChoice kIntegrators[] = {
    {{Integrator::symplectic_euler, "symplectic_euler", "explicit; first order in damping"},
     make_fast,
     {.stable_step = elastic::stable_step, .fast = true, .heading = {"symplectic", "Euler"}}},
    {{Integrator::velocity_verlet, "velocity_verlet",
      "explicit; second order, stable step of twice the damping time"},
     make<Leapfrog>,
     {.stable_step = verlet_stable_step, .heading = {"velocity", "Verlet"}}},
    {{Integrator::runge_kutta_4, "runge_kutta_4",
      "explicit, classical; four force evaluations per step"},
     make<RungeKutta>,
     {.stable_step = runge_kutta_stable_step, .heading = {"Runge-Kutta", "4"}}},
    {{Integrator::backward_euler_cg, "backward_euler_cg",
      "implicit; Newton's systems by conjugate gradients"},
     make<BackwardEuler>,
     {.iterations = kNewtonIterations, .heading = {"backward Euler", "conj. gradients"}}},
    {{Integrator::backward_euler_direct, "backward_euler_direct",
      "implicit; Newton's systems by sparse factorization"},
     make<BackwardEuler>,
     {.iterations = kNewtonIterations, .heading = {"backward Euler", "factorized"}}},
    {{Integrator::xpbd, "xpbd",
      "implicit; extended position based dynamics (Macklin, Mueller, Chentanez 2016)"},
     make<Xpbd>,
     {.iterations = kSweeps, .swept = true, .heading = {"XPBD", "sweep"}}},
    {{Integrator::projective_dynamics, "projective_dynamics",
      "implicit; projective dynamics (Bouaziz, Martin, Liu, Kavan, Pauly 2014)"},
     make<ProjectiveDynamics>,
     {.iterations = kLocalGlobalIterations,
      .swept = true,
      .heading = {"projective dyn.", "iteration"}}},
};

}  // namespace

ChoiceTable<IntegratorChoice> choices(Integrator) {
  return {"integrator", kIntegrators};
}

}  // namespace springlod::sim
