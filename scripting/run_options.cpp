#include "scripting/run_options.hpp"

#include <fmt/format.h>

namespace springlod {

std::vector<Parameter> run_parameters(const RunOptions& usual) {
  return {{.name = "integrator",
           .type = "one of",
           .fallback = "\"symplectic_euler\"",
           .help = "how a step is made; the first three are explicit, the others go on at any step",
           .choices = {"symplectic_euler", "velocity_verlet", "runge_kutta_4", "backward_euler_cg",
                       "backward_euler_direct", "xpbd", "projective_dynamics"}},
          {.name = "iterations",
           .type = "integer",
           .fallback = "20 of Newton, 1 sweep of xpbd, 10 of projective_dynamics",
           .help = "of the implicit schemes, a step"},
          {.name = "tolerance",
           .type = "number",
           .fallback = fmt::format("{}", usual.solver.tolerance),
           .help = "part of the forces at which backward Euler stops iterating"},
          {.name = "step",
           .type = "quantity",
           .dimension = Dimension::time,
           .fallback = "safety times the predicted stable step; 1 ms for the implicit schemes",
           .help = "time step"},
          {.name = "safety",
           .type = "number",
           .fallback = fmt::format("{}", usual.safety),
           .help = "part of the predicted stable step that is taken"},
          {.name = "frame_rate",
           .type = "number",
           .fallback = fmt::format("{}", usual.frame_rate),
           .help = "frames kept a simulated second; 0: first and last only"},
          {.name = "ledger",
           .type = "boolean",
           .fallback = usual.ledger ? "true" : "false",
           .help = "keep account of the energy"}};
}

void read_run_options(Call& call, TableReader& reader, RunOptions& options) {
  reader.choose("integrator", options.integrator,
                {{"symplectic_euler", Integrator::symplectic_euler},
                 {"velocity_verlet", Integrator::velocity_verlet},
                 {"runge_kutta_4", Integrator::runge_kutta_4},
                 {"backward_euler_cg", Integrator::backward_euler_cg},
                 {"backward_euler_direct", Integrator::backward_euler_direct},
                 {"xpbd", Integrator::xpbd},
                 {"projective_dynamics", Integrator::projective_dynamics}});
  reader.read("iterations", options.solver.iterations);
  reader.read("tolerance", options.solver.tolerance);
  reader.read("step", options.step);
  reader.read("safety", options.safety);
  reader.read("frame_rate", options.frame_rate);
  reader.read("ledger", options.ledger);
  options.progress = call.progress();
}

}  // namespace springlod
