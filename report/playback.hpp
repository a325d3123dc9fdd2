#pragma once

#include <cstdint>
#include <vector>

#include "sim/run.hpp"

namespace springlod::report {

/// Positions at time `t`: interpolated linearly between frames, constant before the first and after
/// the last. `frames` must not be empty and must be sorted by time.
std::vector<Vec3> positions_at(const std::vector<sim::Frame>& frames, double t);

/// Centred moving average over `reach` entries on both sides, fewer at the ends. A camera on this
/// path neither lags nor jerks at impacts.
std::vector<Vec3> smoothed(const std::vector<Vec3>& path, std::uint32_t reach);

}  // namespace springlod::report
