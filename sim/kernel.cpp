#include "sim/kernel.hpp"

#include <algorithm>

namespace springlod {
namespace {

// A spring shorter than this part of its rest length has no direction left to push along: its force
// fades to 0 with its length instead of dividing by 0. Far below anything a sound run comes to.
constexpr double kShortest = 1e-9;

}  // namespace

template <bool with_damping>
void add_spring_forces(const MassSpringModel& model, const std::vector<Vec3>& x,
                       const std::vector<Vec3>& v, std::vector<Vec3>& force,
                       std::vector<Vec3>& damping_force) {
  const std::uint32_t spring_count = model.spring_count();
  for (std::uint32_t s = 0; s < spring_count; ++s) {
    const std::uint32_t a = model.a[s];
    const std::uint32_t b = model.b[s];
    const Vec3 along = x[b] - x[a];
    const double length = along.norm();
    const double rest = model.rest_length[s];
    const Vec3 unit = along * (1 / std::max(length, kShortest * rest));
    const double damping = model.damping[s] * unit.dot(v[b] - v[a]);
    const Vec3 pull = (model.stiffness[s] * (length - rest) + damping) * unit;
    force[a] += pull;
    force[b] -= pull;
    if constexpr (with_damping) {
      const Vec3 drag = damping * unit;
      damping_force[a] += drag;
      damping_force[b] -= drag;
    }
  }
}

template void add_spring_forces<true>(const MassSpringModel&, const std::vector<Vec3>&,
                                      const std::vector<Vec3>&, std::vector<Vec3>&,
                                      std::vector<Vec3>&);
template void add_spring_forces<false>(const MassSpringModel&, const std::vector<Vec3>&,
                                       const std::vector<Vec3>&, std::vector<Vec3>&,
                                       std::vector<Vec3>&);

double elastic_energy(const MassSpringModel& model, const std::vector<Vec3>& x) {
  double energy = 0;
  for (std::uint32_t s = 0; s < model.spring_count(); ++s) {
    const double stretch = (x[model.b[s]] - x[model.a[s]]).norm() - model.rest_length[s];
    energy += 0.5 * model.stiffness[s] * stretch * stretch;
  }
  return energy;
}

}  // namespace springlod
