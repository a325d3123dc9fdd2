#pragma once

#include <vector>

#include "voxelize/random_springs.hpp"

namespace springlod::voxelize {

/// Stiffness [N/m] of a spring for each pair so that the network has E = 1 Pa by eq. 2 of the
/// paper; `volume` [m3] is of each node. Eq. 2, W = 6 V E, is made to hold for each node by itself:
/// it gives its springs k = 6 V_i w / sum w L^2, and a spring adds up what its two ends give.
/// Inside that is nearly one k for all. On the surface, where a node stands for half a volume and
/// yet has springs all around, one k for all would lay a stiff skin around the body (1000 nodes in
/// a cube: E 12 % too large).
///
/// The shares w = 1 + u A u, u the direction of a spring, make sum k L^2 u u^T of a node the same
/// in all directions, which at the surface, with springs along it and to one side, it is not by
/// itself (a bar 6 nodes thick: E along it 7 % larger than across).
std::vector<double> unit_stiffness(const std::vector<NodePair>& pairs,
                                   const std::vector<double>& volume);

}  // namespace springlod::voxelize
