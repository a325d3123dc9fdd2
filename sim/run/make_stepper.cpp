#include "sim/run/make_stepper.hpp"

#include "sim/fast/fast_leapfrog.hpp"
#include "sim/integrators/backward_euler.hpp"
#include "sim/integrators/leapfrog.hpp"
#include "sim/integrators/projective_dynamics.hpp"
#include "sim/integrators/runge_kutta.hpp"
#include "sim/integrators/xpbd.hpp"

namespace springlod::sim {

std::unique_ptr<Stepper> make_stepper(const MassSpringModel& model, const Scenario& scenario,
                                      const State& start, double step, const RunOptions& options,
                                      const RunPlan& plan) {
  if (options.integrator == Integrator::symplectic_euler)
    return std::make_unique<FastLeapfrog>(model, scenario, start, step,
                                          FastOptions{.ledger = options.ledger,
                                                      .precision = options.precision,
                                                      .threads = options.threads,
                                                      .layout = plan.layout,
                                                      .skin = options.skin});
  const StepperOptions plain{.integrator = options.integrator,
                             .solver = options.solver,
                             .ledger = options.ledger,
                             .skin = options.skin};
  switch (options.integrator) {
    case Integrator::symplectic_euler:  // above
    case Integrator::velocity_verlet:
      return std::make_unique<Leapfrog>(model, scenario, start, step, plain);
    case Integrator::runge_kutta_4:
      return std::make_unique<RungeKutta>(model, scenario, start, step, plain);
    case Integrator::backward_euler_cg:
    case Integrator::backward_euler_direct:
      return std::make_unique<BackwardEuler>(model, scenario, start, step, plain);
    case Integrator::xpbd:
      return std::make_unique<Xpbd>(model, scenario, start, step, plain);
    case Integrator::projective_dynamics:
      return std::make_unique<ProjectiveDynamics>(model, scenario, start, step, plain);
  }
  return nullptr;
}

}  // namespace springlod::sim
