#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::inline model {

/// The nodes of each piece of one material: nodes joined by springs within the material. Rising, by
/// their lowest node; every node is in one.
std::vector<std::vector<std::uint32_t>> material_pieces(const MassSpringModel& model);

}  // namespace springlod::inline model
