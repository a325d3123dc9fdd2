#include "model/material.hpp"

#include <array>

#include <fmt/format.h>

#include "base/error.hpp"
#include "model/ranges.hpp"

namespace springlod::inline model {

double spring_young(const Material& material) {
  return material.young * ((1 + kSpringPoisson) / (1 + material.poisson));
}

double dilatation_modulus(const Material& material) {
  const double nu = material.poisson;
  return material.young * (4 * nu - 1) / (2 * (1 + nu) * (1 - 2 * nu));
}

double affine_young(double work, double dilatation, double volume) {
  if (dilatation == 0) return work / (6 * volume);
  const double shear = work / (15 * volume);
  const double bulk = (work / 9 + dilatation) / volume;
  return 9 * bulk * shear / (3 * bulk + shear);
}

void validate(const Material& material) {
  if (material.name.empty()) throw InputError("a material has no name; give it one");
  const auto require = [&](const char* field, double value, const PhysicalRange& range) {
    if (!range.contains(value))
      throw InputError(
          fmt::format("material \"{}\": {}", material.name, outside(field, value, range)));
  };
  require("young", material.young, range::kYoung);
  require("density", material.density, range::kDensity);
  require("damping", material.damping, range::kDampingTime);
  require("poisson", material.poisson, range::kPoisson);
  for (const float component : {material.colour.r, material.colour.g, material.colour.b})
    require("colour", component, range::kColour);
}

Colour palette_colour(std::size_t index) {
  // Okabe & Ito's palette, which colour-blind readers can distinguish too.
  static constexpr std::array<Colour, 8> kPalette{{{0.90F, 0.62F, 0.00F},
                                                   {0.34F, 0.71F, 0.91F},
                                                   {0.00F, 0.62F, 0.45F},
                                                   {0.94F, 0.89F, 0.26F},
                                                   {0.00F, 0.45F, 0.70F},
                                                   {0.84F, 0.37F, 0.00F},
                                                   {0.80F, 0.47F, 0.65F},
                                                   {0.60F, 0.60F, 0.60F}}};
  return kPalette[index % kPalette.size()];
}

}  // namespace springlod::inline model
