#pragma once

#include <cstdint>

#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Builds a chain: level 0 is `base`, level n is merged from level n - 1 or straight from the base.
/// Then the levels are calibrated by `options.calibrate`; Calibrate::modes also certifies them.
/// Throws InputError if a level cannot be coarser than the one before, or cannot have the number of
/// nodes that `options.keep` requests.
LodChain simplify(MassSpringModel base, const SimplifyOptions& options);

}  // namespace springlod::lod
