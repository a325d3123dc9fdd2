#pragma once

#include "lod/grouping/grouping.hpp"

namespace springlod::lod {

// Groups of two or three nodes that springs join (each size drawn with probability 1/2), grown from
// one node after the other; what is left over stays single (the paper, section 5). How many groups
// come of it is not chosen.

/// Nearest neighbours first, nodes in random order (5.1).
Groups standard_groups(const GroupingTask& task);
/// Key L (1 + 4 g L): short springs between nodes of like material first.
Groups priority_groups(const GroupingTask& task);
/// Gradient first, distance second: the paper's words (5.2).
Groups hard_priority_groups(const GroupingTask& task);

}  // namespace springlod::lod
