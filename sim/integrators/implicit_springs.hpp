#pragma once

#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::sim {

/// Springs in an implicit step of length dt. With l the length at the end of the step and l_n that
/// at its start, k (l - L) + c (l - l_n)/dt is the force of a spring without damping, of stiffness
/// k + c/dt and rest length (k L + c l_n/dt) / (k + c/dt): damping is then part of the energy that
/// the step minimises.
class ImplicitSprings {
 public:
  ImplicitSprings(const MassSpringModel& model, double step);

  /// Stores the lengths at the start of the step.
  void begin_step(const std::vector<Vec3>& x);

  double stiffness(std::uint32_t spring) const { return stiffness_[spring]; }      ///< [N/m]
  double rest_length(std::uint32_t spring) const { return rest_length_[spring]; }  ///< [m]
  /// Sum of k' (l - L')^2 / 2 at x [J].
  double energy(const std::vector<Vec3>& x) const;
  /// Energy that damping dissipates from the start of the step to x: sum of c (l - l_n)^2 / dt [J].
  double damping_loss(const std::vector<Vec3>& x) const;

 private:
  const MassSpringModel* model_;
  double step_;
  std::vector<double> stiffness_, rest_length_, start_length_;
};

/// Direction of spring `s` at x and its length [m]; a spring of zero length gets the direction of
/// the x axis.
struct SpringAxis {
  Vec3 unit;
  double length;
};
SpringAxis spring_axis(const MassSpringModel& model, std::uint32_t spring,
                       const std::vector<Vec3>& x);

}  // namespace springlod::sim
