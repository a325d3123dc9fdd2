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

/// Poisson's ratio of springs alone (Ladd & Kinney 1997; docs/method.md, eq. 1) [1].
inline constexpr double kSpringPoisson = 0.25;

/// An elastic material. Springs alone have Poisson's ratio 1/4; any other one takes dilatation
/// terms (model/dilatation.hpp).
struct Material {
  std::string name;
  double young = 1e6;     ///< Young's modulus E [Pa] > 0
  double density = 1000;  ///< rho [kg/m3] > 0
  /// Damping time beta = c/k [s] >= 0. A mode of angular frequency w has the damping ratio beta w /
  /// 2. Explicit integrators need shorter steps for larger values.
  double damping = 0;
  Colour colour{};
  double poisson = kSpringPoisson;  ///< Poisson's ratio nu [1], -0.2 to 0.495
  bool operator==(const Material&) const = default;
};

/// Young's modulus [Pa] of the springs of a material: that of a network with its shear modulus G
/// and nu = 1/4, 2.5 G. The material's own at nu = 1/4, to the bit.
double spring_young(const Material& material);
/// Lambda = K - 5 G / 3 [Pa]: what the dilatation terms of a material add to the bulk modulus of
/// its springs. 0 at nu = 1/4, below 0 for smaller ratios (docs/method.md, eq. 8b).
double dilatation_modulus(const Material& material);
/// Young's modulus [Pa] from W [N m] of eq. 2, Lambda V [J] and V [m3], for nodes that move
/// affinely.
double affine_young(double work, double dilatation, double volume);

/// Throws InputError unless the values are finite and in range and the name is not empty.
void validate(const Material& material);

/// Colour number `index` of a palette of 8 distinct colours; it repeats after 8.
Colour palette_colour(std::size_t index);

}  // namespace springlod::inline model
