#include "model/material.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::inline model {

void validate(const Material& material) {
  if (material.name.empty()) throw InputError("a material has no name; give it one");
  const auto require = [&](bool ok, const char* field, double value, const char* rule) {
    if (!ok)
      throw InputError(
          fmt::format("material \"{}\": {} = {} must be {}", material.name, field, value, rule));
  };
  require(std::isfinite(material.young) && material.young > 0, "young", material.young,
          "a finite number of pascal above 0");
  require(std::isfinite(material.density) && material.density > 0, "density", material.density,
          "a finite number of kg/m3 above 0");
  require(std::isfinite(material.damping) && material.damping >= 0, "damping", material.damping,
          "a finite number of seconds, 0 or more");
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
