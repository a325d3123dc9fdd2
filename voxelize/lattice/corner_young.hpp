#pragma once

#include <array>
#include <cstdint>

#include "model/mass_spring.hpp"

namespace springlod::voxelize {

/// Young's modulus [Pa] of a corner between nodes of several materials: their harmonic mean, as for
/// springs in series (docs/method.md, eqs. 5 and 8). Equal moduli give exactly that modulus.
inline double corner_young(const MassSpringModel& model,
                           const std::array<std::uint32_t, 4>& nodes) {
  const double first = model.materials[model.material[nodes[0]]].young;
  double compliance = 0;  // relative to that of the first
  for (const std::uint32_t n : nodes)
    compliance += first / model.materials[model.material[n]].young / 4;
  return first / compliance;
}

}  // namespace springlod::voxelize
