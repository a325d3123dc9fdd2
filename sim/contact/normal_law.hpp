#pragma once

#include <algorithm>
#include <cmath>

namespace springlod::sim {

/// Energy of a contact of stiffness k at depth d: k d^2 / 2 inside the obstacle, 0 outside [J].
inline double penalty_energy(double stiffness, double depth) {
  return depth > 0 ? 0.5 * stiffness * depth * depth : 0;
}

/// The larger root of a z^2 + b z + c = 0 for a > 0 and c <= 0, without cancellation.
inline double larger_root(double a, double b, double c) {
  const double root = std::sqrt(std::max(0.0, b * b - 4 * a * c));
  return b > 0 ? -2 * c / (b + root) : (root - b) / (2 * a);
}

/// Normal force between one point and an obstacle over one step: eq. 68 of docs/method.md.
///
/// The force is constant over the step. Its elastic part is the discrete gradient of the energy U
/// of the contact, (U(d_1) - U(d_0)) / (d_1 - d_0) for the depths d_0 at the start and d_1 at the
/// end (Gonzalez 1996, "Time integration and discrete Hamiltonian systems"), so the energy that it
/// takes out of the motion is the stored energy, for any step and stiffness. The damping force is
/// the contact damping times the mean rate of the part of the depth inside the obstacle. The sum
/// never pulls.
class NormalLaw {
 public:
  struct Terms {
    double stiffness = 0;  ///< k [N/m] > 0
    double damping = 0;    ///< damping time of the contact over the length of the step [1] >= 0
    /// Displacement of the point by a unit force during the step, dt^2 / (2 m) [m/N] > 0.
    double mobility = 0;
  };
  NormalLaw() = default;
  explicit NormalLaw(const Terms& terms)
      : stiffness_(terms.stiffness),
        mobility_(terms.mobility),
        inverse_mobility_(1 / terms.mobility),
        stiff_(terms.mobility * terms.stiffness),
        late_(stiff_ * terms.damping),
        inverse_inertia_(1 / (1 + stiff_ / 2 + late_)) {}

  double stiffness() const { return stiffness_; }  ///< [N/m]
  double mobility() const { return mobility_; }    ///< [m/N]

  struct Result {
    double force = 0;  ///< [N] >= 0
    double depth = 0;  ///< at the end of the step [m]
  };
  /// `start`: depth at the start of the step [m], negative outside. `free`: depth at its end
  /// without the contact [m].
  Result solve(double start, double free) const;

 private:
  double stiffness_ = 0, mobility_ = 0;
  double inverse_mobility_ = 0;  // [N/m]
  double stiff_ = 0;             // a k, with a = mobility [1]
  double late_ = 0;              // a k * damping [1]
  double inverse_inertia_ = 1;   // 1 / (1 + stiff / 2 + late) [1]
};

// With e = free, a = mobility, the depth at the end is e - a force(start, end): one quadratic
// equation for each of three cases. The force does not decrease with the end depth, so the solution
// is unique.
inline NormalLaw::Result NormalLaw::solve(double start, double free) const {
  const Result none{0, free};
  const auto at = [&](double depth) -> Result {
    return {(free - depth) * inverse_mobility_, depth};
  };
  if (start <= 0) {
    if (free <= 0) return none;
    // comes in: (e - d)(d - start) = stiff d^2 / 2 + late d (d - start)
    return at(larger_root(1 + stiff_ / 2 + late_, -(start * (1 + late_) + free), free * start));
  }
  // stays inside: e - d = stiff (start + d) / 2 + late (d - start)
  const double inside = (free - (stiff_ / 2 - late_) * start) * inverse_inertia_;
  if (inside > 0) return free > inside ? at(inside) : none;
  // leaves: (e + late start - d)(start - d) = stiff start^2 / 2, and d = start - p with p > 0
  const double gap = free + late_ * start - start;
  const double depth = start - larger_root(1, gap, -stiff_ / 2 * start * start);
  return free > depth ? at(depth) : none;
}

}  // namespace springlod::sim
