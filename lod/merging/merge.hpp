#pragma once

#include "lod/merging/relink.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Merges each group into one node (the paper, section 4.2; docs/method.md, eqs. 18 and 19).
/// Masses, volumes and contact areas add up; the node lies at the centre of mass; it is a border
/// node if any node of the group is. A spring to another group is reattached with k = k0 L0 / L (c
/// likewise), where L0 is its old rest length and L the distance of its new ends; parallel springs
/// add up. A spring is copied bit for bit if neither of its ends was merged. Corners are merged as
/// in merge_corners, dilatation terms as in merge_dilatation.
///
/// No guards are applied. Throws InputError if two joined groups have the same centre of mass
/// (L = 0): see guard_groups.
MassSpringModel merge(const MassSpringModel& fine, const Groups& groups);
/// The same with the result of relink for `fine` and `groups`.
MassSpringModel merge(const MassSpringModel& fine, const Groups& groups, Relinking links);
/// The same without corners and dilatation terms, which groupings do not need.
MassSpringModel merge_springs(const MassSpringModel& fine, const Groups& groups, Relinking links);

/// MassRule::proximity (docs/method.md, eq. 25): redistributes masses and volumes of `base` to the
/// nodes of `coarse`. Each base node is a cube of its volume, cut into eight pieces; each piece
/// goes to the nearest coarse node. A coarse node without a piece gets the nearest piece of a node
/// that has several. Total mass and volume are conserved, the centre of mass is not. Positions,
/// contact areas and springs are unchanged.
void share_by_proximity(const MassSpringModel& base, MassSpringModel& coarse);

}  // namespace springlod::lod
