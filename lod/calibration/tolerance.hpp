#pragma once

#include <cstddef>
#include <cstdint>

namespace springlod::lod {

/// How many of the lowest frequencies are held to the tolerance itself.
inline constexpr std::size_t kLowestModes = 10;
/// What the mean error of the higher modes and of the smooth loads may be, over the tolerance of
/// the lowest frequencies.
inline constexpr double kHigherModesTolerance = 4, kSmoothLoadsTolerance = 8;

/// Mean error of the lowest frequencies that is good enough [1]: `asked` if above 0, else what a
/// level can usually be fitted to, 0.002 sqrt(N0 / N).
double frequency_tolerance(double asked, std::uint32_t base_nodes, std::uint32_t level_nodes);

}  // namespace springlod::lod
