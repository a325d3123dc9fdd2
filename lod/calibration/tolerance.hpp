#pragma once

#include <cstdint>

#include "model/certificate.hpp"

namespace springlod::lod {

/// Tolerances of the higher modes and of the smooth loads, relative to that of the kLowestModes
/// lowest frequencies (docs/method.md, eq. 44).
inline constexpr double kHigherModesTolerance = 3, kSmoothLoadsTolerance = 8;

/// Tolerance of the mean error of the lowest frequencies [1]: `requested` if above 0, otherwise
/// 0.0033 sqrt(N0 / N), which a fit usually reaches (docs/method.md, eq. 43).
double frequency_tolerance(double requested, std::uint32_t base_nodes, std::uint32_t level_nodes);

}  // namespace springlod::lod
