#pragma once

#include <cstdint>

#include "elastic/moduli.hpp"

namespace springlod::voxelize {

struct PeriodicRandomOptions {
  std::uint32_t nodes = 1000;
  double ends = 18;                ///< of springs a node on average
  std::uint32_t least_ends = 14;   ///< of every node
  std::uint32_t relaxations = 20;  ///< rounds of Lloyd's relaxation; build_random takes 20
  std::uint64_t seed = 1;
};

/// A random network without a surface in a box of 1 m, E = 1 Pa by eq. 2 of the paper: nodes spread
/// by best candidates (Mitchell 1991) and Lloyd's relaxation, springs and their k as in
/// build_random. What periodic_stretch says of it tells how far a random model is below eq. 2.
/// Throws InputError for fewer than 100 nodes, whose springs would meet their own images.
elastic::PeriodicNetwork build_periodic_random(const PeriodicRandomOptions& options = {});

}  // namespace springlod::voxelize
