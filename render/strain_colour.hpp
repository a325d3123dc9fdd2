#pragma once

#include "model/material.hpp"

namespace springlod::render {

/// Diverging colour scale: -1 blue (compressed), 0 light grey, 1 red (stretched); clamped. Blue and
/// red are distinguishable for colour-blind readers.
Colour strain_colour(double strain_over_range);

}  // namespace springlod::render
