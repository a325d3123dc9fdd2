#include "render/value_colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/vec.hpp"

namespace springlod::render {
namespace {

// CIELAB (L, a, b): L in equal steps; a and b go from violet through blue and green to yellow, as
// saturated as sRGB allows.
const std::array<Vec3, 4> kStops{Vec3(20, 30, -42), Vec3(44, -9, -32), Vec3(68, -46, 18),
                                 Vec3(92, -12, 76)};

// White point of sRGB, D65 [CIE XYZ].
const Vec3 kWhite(0.9505, 1, 1.0891);

double from_lab(double t) {
  constexpr double kBend = 6. / 29;  // below, the cube root is continued by its tangent
  return t > kBend ? t * t * t : 3 * kBend * kBend * (t - 4. / 29);
}

float screen_value(double linear) {
  constexpr double kBend = 0.0031308;  // end of the linear segment of sRGB
  const double v = std::clamp(linear, 0., 1.);
  return static_cast<float>(v <= kBend ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055);
}

Colour screen_colour(const Vec3& lab) {
  const double y = (lab[0] + 16) / 116;
  const Vec3 xyz(kWhite[0] * from_lab(y + lab[1] / 500), kWhite[1] * from_lab(y),
                 kWhite[2] * from_lab(y - lab[2] / 200));
  Mat3 to_rgb;  // IEC 61966-2-1
  to_rgb << 3.2406, -1.5372, -0.4986, -0.9689, 1.8758, 0.0415, 0.0557, -0.2040, 1.0570;
  const Vec3 rgb = to_rgb * xyz;
  return {screen_value(rgb[0]), screen_value(rgb[1]), screen_value(rgb[2])};
}

}  // namespace

Colour value_colour(double part) {
  const double t = std::isfinite(part) ? std::clamp(part, 0., 1.) : 0;
  const double at = t * (kStops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double f = at - static_cast<double>(low);
  return screen_colour(kStops[low] + f * (kStops[low + 1] - kStops[low]));
}

}  // namespace springlod::render
