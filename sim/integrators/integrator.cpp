#include "sim/integrators/integrator.hpp"

namespace springlod {
namespace {

constexpr std::uint32_t kNewtonIterations = 20;  // Newton rarely wants more than 5
constexpr std::uint32_t kSweeps = 1;
constexpr std::uint32_t kLocalGlobalIterations = 10;

}  // namespace

const char* to_string(Integrator integrator) {
  switch (integrator) {
    case Integrator::symplectic_euler:
      return "symplectic_euler";
    case Integrator::velocity_verlet:
      return "velocity_verlet";
    case Integrator::runge_kutta_4:
      return "runge_kutta_4";
    case Integrator::backward_euler_cg:
      return "backward_euler_cg";
    case Integrator::backward_euler_direct:
      return "backward_euler_direct";
    case Integrator::xpbd:
      return "xpbd";
    case Integrator::projective_dynamics:
      return "projective_dynamics";
  }
  return "";
}

bool is_implicit(Integrator integrator) {
  switch (integrator) {
    case Integrator::symplectic_euler:
    case Integrator::velocity_verlet:
    case Integrator::runge_kutta_4:
      return false;
    case Integrator::backward_euler_cg:
    case Integrator::backward_euler_direct:
    case Integrator::xpbd:
    case Integrator::projective_dynamics:
      return true;
  }
  return false;
}

std::uint32_t iterations_of(Integrator integrator, const SolverOptions& options) {
  if (!is_implicit(integrator)) return 0;
  if (options.iterations > 0) return options.iterations;
  if (integrator == Integrator::xpbd) return kSweeps;
  if (integrator == Integrator::projective_dynamics) return kLocalGlobalIterations;
  return kNewtonIterations;
}

}  // namespace springlod
