#include "model/drawn_colour.hpp"

namespace springlod::inline model {

Colour drawn_colour(const std::vector<Material>& materials, std::uint32_t number) {
  const Colour& own = materials[number].colour;
  return own == Colour{} ? palette_colour(number) : own;
}

Colour part_colour(const MeshPart& part, std::size_t number,
                   const std::vector<Material>& materials) {
  for (std::uint32_t m = 0; m < materials.size(); ++m)
    if (materials[m].name == part.name || materials[m].name == part.material)
      return drawn_colour(materials, m);
  return palette_colour(number);
}

}  // namespace springlod::inline model
