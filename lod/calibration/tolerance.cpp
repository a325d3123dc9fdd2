#include "lod/calibration/tolerance.hpp"

#include <cmath>

namespace springlod::lod {

double frequency_tolerance(double requested, std::uint32_t base_nodes, std::uint32_t level_nodes) {
  constexpr double kOfBase = 0.0033;
  return requested > 0 ? requested
                       : kOfBase * std::sqrt(static_cast<double>(base_nodes) / level_nodes);
}

}  // namespace springlod::lod
