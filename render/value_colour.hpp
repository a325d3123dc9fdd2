#pragma once

#include "model/material.hpp"

namespace springlod::render {

/// Sequential colour scale: from 0, dark violet, through blue and green to 1, pale yellow; clamped.
/// CIELAB lightness is linear, so that equal steps look equal, also in greyscale and to
/// colour-blind readers.
Colour value_colour(double part);

}  // namespace springlod::render
