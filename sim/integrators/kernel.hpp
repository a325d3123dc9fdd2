#pragma once

#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// The plain reference kernel that faster ones are measured against: one spring after the other in
/// the model's order, doubles, each spring scattered to both its ends.
///
/// Adds to `force` [N], N entries, the force k (l - L) + c dl/dt of every spring along it, then
/// those of the dilatation terms (add_dilatation_forces); dl/dt is taken from the velocities `v`.
/// With `with_damping` the part c dl/dt is also added to `damping_force`: the ledger needs it, and
/// `force` has the same bits in both cases.
template <bool with_damping>
void add_internal_forces(const MassSpringModel& model, const std::vector<Vec3>& x,
                         const std::vector<Vec3>& v, std::vector<Vec3>& force,
                         std::vector<Vec3>& damping_force);

extern template void add_internal_forces<true>(const MassSpringModel&, const std::vector<Vec3>&,
                                               const std::vector<Vec3>&, std::vector<Vec3>&,
                                               std::vector<Vec3>&);
extern template void add_internal_forces<false>(const MassSpringModel&, const std::vector<Vec3>&,
                                                const std::vector<Vec3>&, std::vector<Vec3>&,
                                                std::vector<Vec3>&);

/// Sum of k (l - L)^2 / 2, and the energy of the dilatation terms [J].
double elastic_energy(const MassSpringModel& model, const std::vector<Vec3>& x);

}  // namespace springlod::sim
