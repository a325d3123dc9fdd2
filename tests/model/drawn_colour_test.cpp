#include "model/drawn_colour.hpp"

#include <catch2/catch.hpp>

using springlod::Colour;
using springlod::drawn_colour;
using springlod::Material;
using springlod::MeshPart;
using springlod::palette_colour;
using springlod::part_colour;

TEST_CASE("a part has the colour of the material of its name, else one of the palette") {
  Material grey, red;
  grey.name = "rod";
  red.name = "rubber";
  red.colour = {0.8F, 0.1F, 0.1F};
  const std::vector<Material> materials{grey, red};
  CHECK(part_colour({.name = "joint", .material = "rubber"}, 5, materials) == red.colour);
  CHECK(part_colour({.name = "rubber", .material = ""}, 5, materials) == red.colour);
  CHECK(part_colour({.name = "joint", .material = "rod"}, 5, materials) == palette_colour(0));
  CHECK(part_colour({.name = "lid", .material = "tin"}, 5, materials) == palette_colour(5));
  CHECK(drawn_colour(materials, 1) == red.colour);
}
