#pragma once

#include <vector>

#include "voxelize/random/random_springs.hpp"

namespace springlod::voxelize {

/// Stiffness [N/m] of a spring for each pair, such that the network has E = 1 Pa by eq. 2; `volume`
/// [m3] of each node (docs/method.md, eqs. 6 and 7). Eq. 2, W = 6 V E, holds at each node
/// separately: the node contributes k = 6 V_i w / sum w L^2 to its springs, and a spring has the
/// sum of the contributions of its two ends.
///
/// Inside the body nearly all k are equal. A surface node has about half a volume, but springs all
/// around; one k for all would make the surface too stiff (1000 nodes in a cube: E 13 % too large).
///
/// The weights w = 1 + u A u, with u the direction of a spring, make sum k L^2 u u^T of a node
/// isotropic. With w = 1 it is not isotropic at the surface, where all springs lie along it or on
/// one side of it (a bar 6 nodes thick: E 7 % larger along it than across).
std::vector<double> unit_stiffness(const std::vector<NodePair>& pairs,
                                   const std::vector<double>& volume);

}  // namespace springlod::voxelize
