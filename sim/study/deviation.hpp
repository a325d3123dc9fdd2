#pragma once

#include <vector>

#include "model/vec.hpp"
#include "sim/run.hpp"

namespace springlod::sim {

/// sqrt(sum m |p - q|^2 / sum m) [m].
double rms_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                    const std::vector<double>& mass);

/// The same after the rotation and translation of p that minimize it (Kabsch 1976).
double rms_distance_after_fit(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                              const std::vector<double>& mass);

/// Distance between two bodies at one instant.
struct Deviation {
  double time = 0;     ///< [s]
  double surface = 0;  ///< rms_distance [m]
  double shape = 0;    ///< rms_distance_after_fit [m]
};

/// Distances of all frames, as long as both runs have frames at the same instants. The frames of a
/// level must be mapped to level 0.
std::vector<Deviation> deviation_over_time(const std::vector<Frame>& frames,
                                           const std::vector<Frame>& base,
                                           const std::vector<double>& mass);

}  // namespace springlod::sim
