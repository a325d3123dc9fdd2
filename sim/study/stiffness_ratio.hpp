#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/chain.hpp"

namespace springlod::sim {

/// Which nodes of a level-0 model are stiff: all except those of its softest material. In a body of
/// one material: those on the far side of the centre of mass, along the body's longest side.
struct StiffPart {
  std::vector<std::uint8_t> of_node;  ///< N; 1: stiff
  /// Young's modulus of each node's material over that of the softest [1], N.
  std::vector<double> ratio;
  double softest = 0;  ///< Young's modulus of the soft nodes [Pa]
  std::string name;    ///< "rod", "the half beyond the centre of mass along z"
};
/// Throws InputError if there is no other half (all nodes in one plane across the longest side).
StiffPart stiff_part(const MassSpringModel& base);

/// The chain with the Young's moduli of the stiff and the soft part in the ratio `ratio`. The soft
/// part keeps its springs; springs between both parts get the harmonic mean; damping times, masses
/// and positions stay unchanged. Exact for `centers` lattices; on `corners` lattices a spring
/// counts by the materials of its two nodes. At the ratio of the asset, a body of two materials
/// stays unchanged except for rounding.
///
/// A spring of a coarser level is multiplied by the relative change of sum k L over the level-0
/// springs between its two groups. The result equals merging the rescaled base with the same
/// groups, times the factor that calibration applied to the spring.
LodChain with_stiffness_ratio(const LodChain& chain, const StiffPart& part, double ratio);

}  // namespace springlod::sim
