#pragma once

#include "lod/grouping/grouping.hpp"

namespace springlod::lod {

// Groups of two or three nodes joined by springs (each size drawn with probability 1/2), grown node
// by node; nodes without a free neighbour stay single (the paper, section 5). The number of groups
// follows from the model.

/// Nearest neighbours first, nodes in random order (the paper, section 5.1).
Groups standard_groups(const GroupingTask& task);
/// Key L (1 + 4 gamma L), with the gradient gamma of the spring: short springs between nodes of
/// like material first (docs/method.md, eq. 23).
Groups priority_groups(const GroupingTask& task);
/// Gradient first, distance second, as the paper describes it (section 5.2).
Groups hard_priority_groups(const GroupingTask& task);

}  // namespace springlod::lod
