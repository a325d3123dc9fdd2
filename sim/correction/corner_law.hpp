#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "model/mass_spring.hpp"

namespace springlod::sim {

// The resistance of a corner (model/corners.hpp) against inversion: eq. 68a of docs/method.md.

/// Stiffness of a corner against J, for a corner of volume V0 at rest [m3]: K in U = K d^2 / 2 with
/// d = kCornerResists - J [J].
double corner_stiffness(const Corner& corner, double rest_volume);

/// Sum of U over all corners at the positions x [m]: [J].
double corner_energy(const MassSpringModel& model, const std::vector<Vec3>& x);
/// Sum of U over some corners.
double corner_energy(const MassSpringModel& model, const std::vector<std::uint32_t>& corners,
                     const std::vector<Vec3>& x);

/// The nodes of a corner at four positions [m].
using CornerNodes = std::array<Vec3, 4>;

/// Signed volume [m3].
inline double volume_at(const CornerNodes& at) {
  return (at[1] - at[0]).dot((at[2] - at[0]).cross(at[3] - at[0]));
}

/// Derivatives of the volume with respect to the four positions [m2].
inline CornerNodes volume_gradient(const CornerNodes& at) {
  const Vec3 e1 = at[1] - at[0];
  const Vec3 e2 = at[2] - at[0];
  const Vec3 e3 = at[3] - at[0];
  const Vec3 g1 = e2.cross(e3);
  const Vec3 g2 = e3.cross(e1);
  const Vec3 g3 = e1.cross(e2);
  return {-(g1 + g2 + g3), g1, g2, g3};
}

}  // namespace springlod::sim
