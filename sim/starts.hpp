#pragma once

#include <cstdint>

#include "sim/scenario.hpp"

namespace springlod {

/// The start of run number `index`: speed times 1 + jitter u1, height (z of the centre of mass)
/// times 1 + jitter u2, with u1, u2 uniform in [-1, 1) from (seed, index) alone; index 0 stays as
/// it is. `center`: centre of mass of the model, which a start that is not placed keeps.
Throw jittered(const Throw& start, const Vec3& center, double jitter, std::uint64_t seed,
               std::uint32_t index);

}  // namespace springlod
