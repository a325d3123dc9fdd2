#include "sim/integrators/kernel.hpp"

#include <algorithm>

#include "elastic/tangent.hpp"
#include "sim/integrators/dilatation.hpp"

namespace springlod::sim {
namespace {

// The direction of a spring shorter than this fraction of its rest length is undefined. Its force
// decreases to 0 with its length, which avoids a division by 0. Stable runs never come near this
// length.
constexpr double kShortest = 1e-9;

}  // namespace

template <bool with_damping>
void add_internal_forces(const MassSpringModel& model, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& v, std::vector<Vec3>& force,
                         std::vector<Vec3>& damping_force) {
  const std::uint32_t spring_count = model.spring_count();
  for (std::uint32_t s = 0; s < spring_count;) {
    // Springs are sorted by a. The forces on one a are summed in registers before they are stored;
    // otherwise every spring would wait for the store of the previous one.
    const std::uint32_t a = model.a[s];
    const Vec3& xa = x[a];
    const Vec3& va = v[a];
    Vec3 force_a = force[a];
    Vec3 damping_a = with_damping ? damping_force[a] : Vec3::Zero();
    for (; s < spring_count && model.a[s] == a; ++s) {
      const std::uint32_t b = model.b[s];
      const Vec3 along = x[b] - xa;
      const double length = along.norm();
      const double rest = model.rest_length[s];
      const Vec3 unit = along * (1 / std::max(length, kShortest * rest));
      const double damping = model.damping[s] * unit.dot(v[b] - va);
      const Vec3 pull = (model.stiffness[s] * (length - rest) + damping) * unit;
      force_a += pull;
      force[b] -= pull;
      if constexpr (with_damping) {
        const Vec3 drag = damping * unit;
        damping_a += drag;
        damping_force[b] -= drag;
      }
    }
    force[a] = force_a;
    if constexpr (with_damping) damping_force[a] = damping_a;
  }
  add_dilatation_forces<with_damping>(model.dilatation, x, v, force, damping_force);
}

template void add_internal_forces<true>(const MassSpringModel&, const std::vector<Vec3>&,
                                        const std::vector<Vec3>&, std::vector<Vec3>&,
                                        std::vector<Vec3>&);
template void add_internal_forces<false>(const MassSpringModel&, const std::vector<Vec3>&,
                                         const std::vector<Vec3>&, std::vector<Vec3>&,
                                         std::vector<Vec3>&);

double elastic_energy(const MassSpringModel& model, const std::vector<Vec3>& x) {
  return elastic::strain_energy(model, x);
}

}  // namespace springlod::sim
