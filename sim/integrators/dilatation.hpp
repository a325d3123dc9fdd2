#pragma once

#include <vector>

#include "model/dilatation.hpp"
#include "sim/integrators/integrator.hpp"

namespace springlod::sim {

/// Whether a scheme has the forces of dilatation terms, besides those of springs.
inline bool knows_terms(Integrator integrator) {
  return !is_implicit(integrator);
}

/// The plain reference kernel of dilatation terms: one term after the other, doubles. Adds to
/// `force` [N], N entries, -T (eps + beta d eps/dt) d eps/dx of each term; d eps/dt is taken from
/// the velocities `v`. With `with_damping` the part of d eps/dt is also added to `damping_force`.
template <bool with_damping>
void add_dilatation_forces(const DilatationTerms& terms, const std::vector<Vec3>& x,
                           const std::vector<Vec3>& v, std::vector<Vec3>& force,
                           std::vector<Vec3>& damping_force);

extern template void add_dilatation_forces<true>(const DilatationTerms&, const std::vector<Vec3>&,
                                                 const std::vector<Vec3>&, std::vector<Vec3>&,
                                                 std::vector<Vec3>&);
extern template void add_dilatation_forces<false>(const DilatationTerms&, const std::vector<Vec3>&,
                                                  const std::vector<Vec3>&, std::vector<Vec3>&,
                                                  std::vector<Vec3>&);

}  // namespace springlod::sim
