#pragma once

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// The dilatation terms of a merged model: one for each node (node_terms), with
/// the sum of the shares that the nodes of its group have in the terms of `fine`
/// (dilatation_shares). So the terms of each group keep their sum of T = Lambda V, as its volume is
/// kept. `coarse` has the nodes and springs of the merged model. Nodes without a term, in
/// flat parts, pass their shares to none.
DilatationTerms merge_dilatation(const MassSpringModel& fine, const Groups& groups,
                                 const MassSpringModel& coarse);

}  // namespace springlod::lod
