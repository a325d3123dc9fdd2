#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "model/chain.hpp"

namespace springlod::sim {

/// Which nodes of a level-0 model are stiff: all but those of its softest material. Of a body of
/// one material, those beyond the centre of mass along its longest side.
struct StiffPart {
  std::vector<std::uint8_t> of_node;  ///< N; 1: stiff
  /// Young's modulus of each node's material over that of the softest [1], N.
  std::vector<double> ratio;
  double softest = 0;  ///< Young's modulus of the soft nodes [Pa]
  std::string name;    ///< "rod", "the half beyond the centre of mass along z"
};
/// Throws InputError if there is no other half (all nodes in one plane across the longest side).
StiffPart stiff_part(const MassSpringModel& base);

/// The chain as it would be if the Young's moduli of the stiff part and the soft one stood in the
/// ratio `ratio`. The soft part keeps its springs; one across a joint gets the harmonic mean;
/// damping times, masses and places stay. Exact for `centers` lattices; on `corners` lattices a
/// spring counts by the materials of its two nodes. At the ratio the asset has, a body of two
/// materials keeps its bits but for rounding.
///
/// A spring of a coarser level changes by the factor by which sum k L of the level-0 springs
/// between its two groups does: what merging the rescaled base by the same groups gives, times
/// whatever a calibration did to the spring.
LodChain with_stiffness_ratio(const LodChain& chain, const StiffPart& part, double ratio);

}  // namespace springlod::sim
