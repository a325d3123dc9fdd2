#include "render/strain_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace springlod::render {

Colour strain_colour(double strain_over_range) {
  // CIELAB lightness decreases evenly from the middle to both ends (about 85, 60, 35).
  static constexpr std::array<Colour, 5> kStops{{{0.10F, 0.25F, 0.60F},
                                                 {0.38F, 0.58F, 0.85F},
                                                 {0.80F, 0.80F, 0.80F},
                                                 {0.91F, 0.48F, 0.37F},
                                                 {0.66F, 0.08F, 0.12F}}};
  const double t = std::isfinite(strain_over_range) ? std::clamp(strain_over_range, -1., 1.) : 0;
  const double at = (t + 1) / 2 * (kStops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const auto f = static_cast<float>(at - static_cast<double>(low));
  const Colour& a = kStops[low];
  const Colour& b = kStops[low + 1];
  return {a.r + f * (b.r - a.r), a.g + f * (b.g - a.g), a.b + f * (b.b - a.b)};
}

}  // namespace springlod::render
