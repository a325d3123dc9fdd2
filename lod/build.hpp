#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "base/progress.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Level 0 = `base`, level n merged from level n-1 (or straight from the base), then all
/// of them calibrated against the base if asked for; with Calibrate::modes they are certified too.
/// Throws InputError if a level cannot get any
/// coarser (says which and why), or not have as many nodes as it should keep.
LodChain simplify(MassSpringModel base, const SimplifyOptions& options);

}  // namespace springlod::lod
