#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "model/material.hpp"
#include "model/mesh.hpp"

namespace springlod::inline model {

/// Colour in which a material is drawn: its own, or a palette colour if it has the default grey, so
/// that materials can be distinguished.
Colour drawn_colour(const std::vector<Material>& materials, std::uint32_t number);

/// Colour of part `number` of a mesh: that of the material that has the name of the part or of its
/// material, else a palette colour.
Colour part_colour(const MeshPart& part, std::size_t number,
                   const std::vector<Material>& materials);

}  // namespace springlod::inline model
