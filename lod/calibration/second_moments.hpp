#pragma once

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Second moments of mass about the centre, sum m (x - c)(x - c)^T [kg m2].
Mat3 second_moments(const MassSpringModel& model);

/// Moves the nodes of a merged level by one linear map for each connected part, which gives every
/// part the second moments of mass that it has in the base: merging takes out what the groups have
/// within (12 to 15 % of a sphere at 20 % of the nodes). Of the maps that do it this is the one
/// that moves the masses least (optimal transport between the two ellipsoids). k L and c L of every
/// spring stay, as they do in a merge. What has no extent along some axis (a sheet, a rope) keeps
/// none.
void restore_second_moments(const MassSpringModel& base, const Groups& of_base,
                            MassSpringModel& level);

}  // namespace springlod::lod
