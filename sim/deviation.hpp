#pragma once

#include <vector>

#include "model/vec.hpp"

namespace springlod {

/// sqrt(sum m |p - q|^2 / sum m) [m].
double rms_distance(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                    const std::vector<double>& mass);

/// The same after the rotation and translation of p that make it least (Kabsch 1976).
double rms_distance_after_fit(const std::vector<Vec3>& p, const std::vector<Vec3>& q,
                              const std::vector<double>& mass);

}  // namespace springlod
