#pragma once

#include <vector>

#include "model/chain.hpp"

namespace springlod::lod {

/// A field on the fine nodes, N, as the mean over each group, weighted by `mass`, N.
std::vector<Vec3> group_means(const std::vector<Vec3>& field, const std::vector<double>& mass,
                              const Groups& groups);

}  // namespace springlod::lod
