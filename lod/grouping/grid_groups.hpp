#pragma once

#include "lod/grouping/grouping.hpp"

namespace springlod::lod {

/// The nodes of each cell of a cubic grid, in as many cells as groups are wanted: the simplest
/// grouping that looks at places. Border and material are not looked at.
Groups grid_groups(const GroupingTask& task);

}  // namespace springlod::lod
