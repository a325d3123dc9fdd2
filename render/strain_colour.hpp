#pragma once

#include "model/material.hpp"

namespace springlod::render {

/// Diverging scale: -1 blue (compressed), 0 light grey, 1 red (stretched); clamped beyond. Blue
/// against red is told apart by colour-blind readers too.
Colour strain_colour(double strain_over_range);

}  // namespace springlod::render
