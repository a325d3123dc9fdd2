#pragma once

#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Two models of one body and the map between their nodes.
struct MergedPair {
  const MassSpringModel& fine;
  const MassSpringModel& coarse;
  const Groups& groups;  ///< node of `fine` -> node of `coarse`
};

/// Which merges changed how the body gives way to loads. `fine` and `coarse` hold, for each of the
/// same loads, the displacements of the two models [m]; what comes back is, for each load, the part
/// of every coarse node in C' - C [J], with C = u.Ku of the fine and C' = u'.K'u' of the coarse
/// model. The parts add up to C' - C to rounding, whatever the models and displacements:
///
///   C' - C = [v.Ku - w.K'u'] + [u'.K'u' - v.Ku] + [w.K'u' - u.Ku]
///
/// where v is u' carried to the fine nodes (base_from_level) and w is u as the mean over each
/// group. The first bracket is a sum over springs: those inside a group count for it, those between
/// two for whichever of them has several nodes, in halves if both or neither have. The other two
/// are sums over nodes. Wherever nothing was merged and no spring changed, all of it is 0: this is
/// the reciprocal form of the change, in which a merge does not count for energy that it merely
/// sends elsewhere. Throws InputError for displacements of the wrong size.
std::vector<std::vector<double>> compliance_changes(const MergedPair& pair,
                                                    const std::vector<std::vector<Vec3>>& fine,
                                                    const std::vector<std::vector<Vec3>>& coarse);

}  // namespace springlod::lod
