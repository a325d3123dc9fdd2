#pragma once

#include <vector>

#include "model/chain.hpp"

namespace springlod::lod {

/// Means of a field on the fine nodes, N, over each group, weighted by `mass`, N [kg].
std::vector<Vec3> group_means(const std::vector<Vec3>& field, const std::vector<double>& mass,
                              const Groups& groups);

}  // namespace springlod::lod
