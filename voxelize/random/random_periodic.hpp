#pragma once

#include <cstdint>

#include "elastic/moduli.hpp"

namespace springlod::voxelize {

struct PeriodicRandomOptions {
  std::uint32_t nodes = 1000;
  double ends = 18;                ///< mean number of spring ends at a node
  std::uint32_t least_ends = 14;   ///< least number at every node
  std::uint32_t relaxations = 20;  ///< rounds of Lloyd's relaxation; 20 in build_random
  std::uint64_t seed = 1;
};

/// A random periodic network in a box of 1 m with E = 1 Pa by eq. 2: nodes by best candidates
/// (Mitchell 1991) and Lloyd's relaxation, springs and their k as in build_random. periodic_stretch
/// of it measures how far the modulus of a random model is below eq. 2. Throws InputError for fewer
/// than 100 nodes, whose springs would reach their own images.
elastic::PeriodicNetwork build_periodic_random(const PeriodicRandomOptions& options = {});

}  // namespace springlod::voxelize
