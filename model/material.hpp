#pragma once

#include <cstddef>
#include <string>

namespace springlod::inline model {

/// A colour as display (sRGB) components in 0..1.
struct Colour {
  float r = 0.7F;
  float g = 0.7F;
  float b = 0.7F;
  bool operator==(const Colour&) const = default;
};

/// An elastic material. A spring lattice has Poisson's ratio 1/4 (Ladd & Kinney 1997;
/// docs/method.md, eq. 1).
struct Material {
  std::string name;
  double young = 1e6;     ///< Young's modulus E [Pa] > 0
  double density = 1000;  ///< rho [kg/m3] > 0
  /// Damping time beta = c/k [s] >= 0. A mode of angular frequency w has the damping ratio beta w /
  /// 2. Explicit integrators need shorter steps for larger values.
  double damping = 0;
  Colour colour{};
  bool operator==(const Material&) const = default;
};

/// Throws InputError unless the values are finite and in range and the name is not empty.
void validate(const Material& material);

/// Colour number `index` of a palette of 8 distinct colours; it repeats after 8.
Colour palette_colour(std::size_t index);

}  // namespace springlod::inline model
