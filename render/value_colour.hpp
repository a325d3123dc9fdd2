#pragma once

#include "model/material.hpp"

namespace springlod::render {

/// Sequential scale for numbers: 0 dark violet, over blue and green, to 1 pale yellow; clamped
/// beyond. Lightness (CIELAB) rises evenly, so that equal steps look equal, in grey print and to
/// colour-blind readers too.
Colour value_colour(double part);

}  // namespace springlod::render
