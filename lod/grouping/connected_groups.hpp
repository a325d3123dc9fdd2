#pragma once

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Makes every group hang together by springs: what hangs on the rest of its group by none goes to
/// the group that most of its springs lead to. The number of groups
/// stays, but that a piece in a connected part of the body without any other group becomes one.
void connect_groups(const MassSpringModel& model, Groups& groups);

}  // namespace springlod::lod
