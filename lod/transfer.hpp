#pragma once

#include <cstdint>

#include "model/binding.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Level-0 nodes from the nodes of level `level`: each hangs on its group's node and that node's
/// spring neighbours. Identity for level 0. Linear: positions and velocities alike.
Binding base_from_level(const LodChain& chain, std::uint32_t level);

}  // namespace springlod::lod
