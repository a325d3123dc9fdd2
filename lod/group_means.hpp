#pragma once

#include <vector>

#include "model/chain.hpp"

namespace springlod::lod {

/// Mass of each group [kg], from that of the fine nodes, N [kg].
std::vector<double> group_masses(const std::vector<double>& mass, const Groups& groups);

/// Means of a field on the fine nodes, N, over each group, weighted by `mass`, N [kg].
std::vector<Vec3> group_means(const std::vector<Vec3>& field, const std::vector<double>& mass,
                              const Groups& groups);

/// Work of `force`, N [N], along the mean displacement of each node's group, N [m]: what a level
/// whose nodes move as their groups do takes as its compliance, since it knows the sum of the
/// forces on a group alone [J]. 0 if the forces on each group cancel.
double work_on_means(const std::vector<Vec3>& force, const std::vector<Vec3>& displacement,
                     const std::vector<double>& mass, const Groups& groups);

}  // namespace springlod::lod
