#pragma once

#include "base/choice.hpp"
#include "model/material.hpp"

namespace springlod::inline model {

/// Materials with published elastic constants. Their rows have the constants and the sources.
enum class MaterialPreset {
  natural_rubber,
  butyl_rubber,
  neoprene,
  ecoflex_00_30,
  dragon_skin_30,
  pdms,
  silicone_gel,
  gelatin,
  cork,
  flexible_foam,
  rigid_foam,
  liver,
  fat,
  muscle,
  hdpe,
  nylon,
  pmma,
  abs,
  aluminium,
  steel,
};

/// A row of the table of presets. Its help says what the material is.
struct MaterialPresetChoice : Choice<MaterialPreset> {
  double young;    ///< at small strain [Pa]
  double poisson;  ///< [1]; 0.495, the largest that models take, where the published one is more
  double density;  ///< [kg/m3]
  const char* source;  ///< where young is from; of a range, the geometric mean is taken
};
ChoiceTable<MaterialPresetChoice> choices(MaterialPreset);

/// Gives a material the constants of a preset; the rest stays.
void apply(MaterialPreset preset, Material& material);

}  // namespace springlod::inline model
