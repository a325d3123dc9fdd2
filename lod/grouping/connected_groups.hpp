#pragma once

#include "model/chain.hpp"
#include "model/mass_spring.hpp"

namespace springlod::lod {

/// Makes every group connected by springs: the largest connected fragment of a group stays; each
/// other fragment joins the neighbouring group that most of its springs lead to. The number of
/// groups grows only by fragments in a component of the body where no group has its largest
/// fragment.
void connect_groups(const MassSpringModel& model, Groups& groups);

}  // namespace springlod::lod
