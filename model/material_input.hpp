#pragma once

#include <optional>

#include "model/material.hpp"

namespace springlod::inline model {

/// Damping ratio of a material for which the user gives no damping [1]: free vibration loses 6 % of
/// its amplitude in each period. In a body of one material, it shortens the stable step by less
/// than half if the body is at most 100 cells long.
inline constexpr double kUsualDampingRatio = 0.01;

/// A material as a user describes it. Its damping is a time, or a ratio that becomes a time once
/// the size of the body is known: only a ratio has the same effect on bodies of any size.
struct MaterialInput {
  /// By default with the usual ratio. `material.damping` is then without meaning.
  Material material = {};
  /// Damping ratio zeta of the body's slowest vibration [1], in [0, 1); none: material.damping is
  /// the damping time.
  std::optional<double> damping_ratio = kUsualDampingRatio;
  bool operator==(const MaterialInput&) const = default;
};

/// Throws InputError as for a Material, and unless a damping ratio lies in [0, 1).
void validate(const MaterialInput& input);

/// Estimate of the lowest angular frequency of a free body [rad/s] from its largest extent [m] > 0
/// and the speed of longitudinal waves in a bar of its material, sqrt(E / rho) [m/s]: pi c / L,
/// that of a free bar, and within 1 % that of a sphere with Poisson's ratio 1/4. Bending of a
/// slender body is slower. Errors on samples: docs/models.md.
double lowest_frequency_estimate(double wave_speed, double extent);

/// The material with its damping as a time: beta = 2 zeta / omega for a ratio zeta, with the lowest
/// angular frequency omega of the body [rad/s]; 0 if omega is 0 (nothing vibrates).
Material resolved(const MaterialInput& input, double omega);

}  // namespace springlod::inline model
