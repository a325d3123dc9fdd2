#pragma once

#include <cstdint>

#include "lod/options.hpp"
#include "model/chain.hpp"

namespace springlod::lod {

/// Calibrates every level above the base, each connected component by itself: restores the second
/// moments of mass of the base (restore_second_moments), stiffens long springs
/// (favour_long_springs), and fits stiffnesses and masses (fit_part). The base is measured once.
/// Results are bit-identical for any number of threads and after a resume. Throws InputError where
/// elastic_body does, for regions without free border nodes and for a negative keep_every, IoError
/// if the store cannot be written, InterruptedError once `progress` asks to stop.
void calibrate(LodChain& chain, const CalibrateOptions& options = {});

}  // namespace springlod::lod
