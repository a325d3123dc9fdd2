#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::bench {

/// A floor at z = 0 and gravity along -z.
struct Floor {
  double stiffness = 1e6;  ///< kappa [N/m3]
  double friction = 0.5;
  double gravity = 9.81;  ///< [m/s2]
};

/// Reference for the fast kernels: the straightforward step on plain arrays of doubles. A loop over
/// springs adds forces to both ends; a loop over nodes handles floor, friction and symplectic
/// Euler. It must not be optimized, so that results stay comparable.
struct NaiveBody {
  using Triple = std::array<double, 3>;
  std::vector<Triple> x, v, f;
  std::vector<double> mass, area;
  std::vector<std::uint32_t> a, b;
  std::vector<double> length, stiffness, damping;
};

NaiveBody naive_body(const MassSpringModel& model);
void naive_step(NaiveBody& body, const Floor& floor, double step);

}  // namespace springlod::bench
