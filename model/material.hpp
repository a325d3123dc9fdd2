#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace springlod::inline model {

/// Linear RGB would be overkill for a legend: these are display (sRGB) components in 0..1.
struct Colour {
  float r = 0.7F;
  float g = 0.7F;
  float b = 0.7F;
  bool operator==(const Colour&) const = default;
};

/// An elastic material. Springs alone give Poisson's ratio 1/4 (spec: Ladd & Kinney 1997).
struct Material {
  std::string name;
  double young = 1e6;     ///< Young's modulus E [Pa] > 0
  double density = 1000;  ///< rho [kg/m3] > 0
  /// Damping time beta = c/k [s] >= 0. A mode of angular frequency w has the damping ratio beta w /
  /// 2: by default 6 % at 100 Hz, where a soft body that fits a hand moves. Explicit steps pay for
  /// more.
  double damping = 0.0002;
  Colour colour{};
  bool operator==(const Material&) const = default;
};

/// Throws InputError unless the values are finite and in range and the name is not empty.
void validate(const Material& material);

/// A colour that tells material number `index` from its neighbours; repeats after 8.
Colour palette_colour(std::size_t index);

}  // namespace springlod::inline model
