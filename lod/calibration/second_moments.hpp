#pragma once

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Second moments of mass about the centre of mass c, sum m (x - c)(x - c)^T [kg m2].
Mat3 second_moments(const MassSpringModel& model);

/// Restores the second moments of mass of each connected component of a merged level by one linear
/// map of its nodes (docs/method.md, eq. 27). Merging removes the moments within the groups: 12 to
/// 15 % of a sphere's at 20 % of the nodes. This is the linear map that restores the moments with
/// the smallest displacement of the masses (optimal transport between two ellipsoids). k L and c L
/// of every spring are conserved as in a merge. A component that is flat along an axis (a sheet, a
/// rope) stays flat. Corners that the map makes too flat are removed.
void restore_second_moments(const MassSpringModel& base, const Groups& of_base,
                            MassSpringModel& level);

}  // namespace springlod::lod
