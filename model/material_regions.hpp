#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// The nodes of each material region: a set of nodes of one material that springs within the
/// material connect. Every node is in one region. Regions are sorted by their lowest node, and the
/// nodes of each region are ascending.
std::vector<std::vector<std::uint32_t>> material_regions(const MassSpringModel& model);

}  // namespace springlod::inline model
