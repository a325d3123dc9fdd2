#pragma once

#include "lod/build.hpp"
#include "scripting/engine/call.hpp"

namespace springlod::scripting {

/// The options `calibrate` and `calibration` of simplify, of levels of `base`.
void read_calibration(Call& call, TableReader& reader, const MassSpringModel& base,
                      lod::SimplifyOptions& options);

}  // namespace springlod::scripting
