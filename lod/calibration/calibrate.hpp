#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "base/progress.hpp"
#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Fits every level but the base to the base: gives it the base's second moments of mass
/// (restore_second_moments), favours its long springs, and fits stiffnesses and masses (fit_part),
/// each connected part by itself. What is measured of the base is measured once.
/// The same bits for any number of threads, and from a store. Throws InputError where elastic_body
/// does, for regions that loads cannot move and for a negative keep_every, IoError if the store
/// cannot be written, InterruptedError once `progress` asks to stop.
void calibrate(LodChain& chain, const CalibrateOptions& options = {});

}  // namespace springlod::lod
