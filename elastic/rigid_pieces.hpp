#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

inline constexpr std::uint32_t kNoPiece = std::numeric_limits<std::uint32_t>::max();

/// Sets of nodes that springs hold rigid: a tetrahedron of springs, and whatever hangs on a rigid
/// piece by springs in three independent directions. Not every rigid piece is of this kind.
struct RigidPieces {
  std::vector<std::uint32_t> of_node;  ///< N; kNoPiece for nodes in none
  std::uint32_t count = 0;
};
RigidPieces rigid_pieces(const MassSpringModel& model);

}  // namespace springlod::elastic
