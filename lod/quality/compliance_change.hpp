#pragma once

#include <vector>

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// A model, a coarser model of the same body, and the map between their nodes.
struct MergedPair {
  const MassSpringModel& fine;
  const MassSpringModel& coarse;
  const Groups& groups;  ///< node of `fine` -> node of `coarse`
};

/// Attributes the change of static compliance to single merges (docs/method.md, eq. 51). `fine` and
/// `coarse` are the displacements of the two models under the same loads, one field for each load
/// [m]. Returns for each load the contribution of every coarse node to C' - C [J], where C = u.Ku
/// and C' = u'.K'u'. The contributions add up to C' - C to rounding for any models and
/// displacements:
///
///   C' - C = [v.Ku - w.K'u'] + [u'.K'u' - v.Ku] + [w.K'u' - u.Ku]
///
/// where v is u' interpolated to the fine nodes (base_from_level) and w is the mean of u over each
/// group. The first bracket is a sum over springs. A spring inside a group counts for that group; a
/// spring between two groups counts for the one with several nodes, or half for each if both or
/// neither have several; dilatation terms likewise. The other two brackets are sums over nodes. All
/// terms are 0 where nothing was merged and no spring changed, so a merge is not charged for energy
/// that it only moves elsewhere. Throws InputError for displacements of the wrong size.
std::vector<std::vector<double>> compliance_changes(const MergedPair& pair,
                                                    const std::vector<std::vector<Vec3>>& fine,
                                                    const std::vector<std::vector<Vec3>>& coarse);

}  // namespace springlod::lod
