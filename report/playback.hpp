#pragma once

#include <cstdint>
#include <vector>

#include "sim/run.hpp"

namespace springlod::report {

/// Positions at time `t`, linear between frames; before the first and after the last they hold.
/// `frames` is not empty and in rising order of time.
std::vector<Vec3> positions_at(const std::vector<sim::Frame>& frames, double t);

/// Running mean over `reach` entries to both sides, shorter at the ends: a camera on this path
/// neither lags nor jerks at an impact.
std::vector<Vec3> smoothed(const std::vector<Vec3>& path, std::uint32_t reach);

}  // namespace springlod::report
