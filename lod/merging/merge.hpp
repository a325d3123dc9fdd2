#pragma once

#include "lod/merging/relink.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Merges each group into one node (the paper, section 4.2): masses, volumes and contact areas add
/// up, the node sits at the centre of mass, it is a border node if any was. A spring to another
/// group is reattached with k = k0 L0 / L (c likewise), L0 its own old rest length and L the
/// distance of the new ends; parallel springs are added up. A spring neither of whose ends merged
/// keeps its bits.
///
/// This is the raw merge, without guards. Throws InputError if two joined groups have the same
/// centre of mass (L = 0): see guard_groups.
MassSpringModel merge(const MassSpringModel& fine, const Groups& groups);
/// The same with what relink told of the springs of `fine` and these groups.
MassSpringModel merge(const MassSpringModel& fine, const Groups& groups, Relinking links);

/// MassRule::proximity: masses and volumes of `base`, cut into pieces, shared out anew among the
/// nodes of `coarse`, which stay where they are. The pieces are those of the nodes of `base`, each
/// a cube of its volume cut into eight; a node nearest to none gets its nearest. Total mass and
/// volume stay, the centre of mass does not. Contact areas and springs stay too.
void share_by_proximity(const MassSpringModel& base, MassSpringModel& coarse);

}  // namespace springlod::lod
