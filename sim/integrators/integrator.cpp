#include "sim/integrators/integrator.hpp"

namespace springlod::sim {

bool is_implicit(Integrator integrator) {
  return choice_of(integrator).traits.stable_step == nullptr;
}

std::uint32_t iterations_of(Integrator integrator, const SolverOptions& options) {
  if (!is_implicit(integrator)) return 0;
  return options.iterations > 0 ? options.iterations : choice_of(integrator).traits.iterations;
}

}  // namespace springlod::sim
