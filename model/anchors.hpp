#pragma once

#include <cstdint>
#include <vector>

#include "base/option.hpp"
#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// Anchored nodes keep their positions. Functions take them as a list of node numbers, in any
/// order; duplicates count once.

/// Flags, N: 1 for an anchored node. Throws InputError for a node that the model does not have.
std::vector<std::uint8_t> anchor_flags(const MassSpringModel& model,
                                       const std::vector<std::uint32_t>& anchored);

/// The option row of nodes that are held.
template <class S>
constexpr NodesOption<S> anchored_option(std::vector<std::uint32_t> S::*member) {
  NodesOption<S> row = nodes_option("anchored", member,
                                    "nodes that are held in place: their numbers, a function of a "
                                    "Node that returns true for them, or the anchors of a run",
                                    "none");
  row.held = true;
  return row;
}

}  // namespace springlod::inline model
