#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::elastic {

/// Motions of one connected part that no spring resists.
struct PartModes {
  std::uint32_t first_node = 0;  ///< lowest node of the part
  std::uint32_t node_count = 0;
  std::uint32_t anchored = 0;  ///< how many of its nodes are held
  std::uint32_t zero_modes = 0;
  /// What a sound part of this shape has: 6, a straight line of nodes 5, a single node 3; none if
  /// it is anchored.
  std::uint32_t expected = 6;
  /// Nodes that take part in a mechanism (a zero mode that is no rigid motion; of an anchored part
  /// any zero mode), worst first: those that move while the largest rigid piece of the part rests.
  /// Where there is no such piece (no four nodes joined each to each), those that move when the
  /// rigid motions are taken out.
  std::vector<std::uint32_t> mechanism_nodes;
};

/// Counts the zero modes of each connected part, to first order about rest; they depend on where
/// the springs run and not on how stiff they are. Pieces that are rigid beyond doubt are found
/// first and move as one body each, which leaves few unknowns even of large models; the zero modes
/// of the rest are counted by Sylvester's law of inertia and their motions found by inverse
/// iteration. Anchored nodes are held by springs to the ground, as stiff as all others.
/// Throws InputError for an anchored node that the model does not have.
std::vector<PartModes> zero_modes(const MassSpringModel& model,
                                  const std::vector<std::uint32_t>& anchored = {});

}  // namespace springlod::elastic
