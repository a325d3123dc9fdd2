#pragma once

#include <cstddef>
#include <vector>

#include "elastic/loads/static_loads.hpp"

namespace springlod {

struct PieceOptions {
  std::size_t most_pieces = 6;   ///< the largest ones
  std::size_t least_nodes = 20;  ///< of a piece: fewer have no stiffness of their own
};

/// The nine smooth loads on each piece of one material alone (nodes joined by springs within the
/// material) that reaches the surface, for how stiff it is by itself: loads on the whole body tell
/// little of stiff pieces that soft ones join. "stretch x of rod at node 0", ... None if the body
/// is one piece.
std::vector<StaticLoad> piece_loads(const MassSpringModel& model, const PieceOptions& options = {});

}  // namespace springlod
