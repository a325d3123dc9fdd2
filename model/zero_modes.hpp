#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod {

/// Motions of one connected part that no spring resists.
struct PartModes {
  std::uint32_t first_node = 0;  ///< lowest node of the part
  std::uint32_t node_count = 0;
  std::uint32_t zero_modes = 0;
  /// What a sound part of this shape has: 6, a straight line of nodes 5, a single node 3.
  std::uint32_t expected = 6;
  /// Nodes that take part in a mechanism (a zero mode that is no rigid motion), worst first.
  std::vector<std::uint32_t> mechanism_nodes;
};

/// Counts the zero modes of each connected part by block inverse iteration on K + sigma I.
std::vector<PartModes> zero_modes(const MassSpringModel& model);

}  // namespace springlod
