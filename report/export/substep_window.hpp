#pragma once

#include <string>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::report {

/// Substeps for engines that, in each substep, move the nodes by their velocities and then correct
/// every spring once, one after another, in single precision (XPBD with one iteration; Jolt, and
/// Bullet's position-based solver).
///
/// Their static deformation is wrong in two ways, which docs/export.md states with measurements:
/// - One sweep leaves an error of the order dt^2 / m beside the compliance 1 / k of a spring. As a
///   share of the body's compliance that is kSweepError (frequency dt)^2.
/// - A substep adds g dt^2 to a position. If that is not large beside the spacing of single
///   precision numbers there, rounding loses a share kRoundingError spacing / (g dt^2) of gravity.
/// The first bounds the rate from below, the second from above.
struct SubstepWindow {
  /// Root of the mean of k / m over the springs, by their energy in uniform stress [rad/s]: soft
  /// materials count more, since they deform more. Below the highest frequency.
  double frequency = 0;
  double from = 0, to = 0;  ///< rates within kWindowError [1/s]; both 0 if there are none
  double rate = 0;          ///< to recommend [1/s]: the least within kGoodError, or the best
  double error = 0;         ///< estimated relative error of the static deformation at `rate` [1]

  bool empty() const { return to <= 0; }
};

// Measured on 18 hanging bodies (tests/peers/jolt_rates.mjs): upper ends of what they show.
inline constexpr double kSweepError = 0.33;
inline constexpr double kRoundingError = 0.15;
inline constexpr double kWindowError = 0.02;
inline constexpr double kGoodError = 0.01;

/// `gravity`: its size [m/s2]; 0 counts as that of the earth. `extent`: largest coordinate that the
/// engine stores for a node [m].
SubstepWindow substep_window(const MassSpringModel& model, double gravity, double extent);

/// Substeps of a step of 1/60 s.
struct FrameSubsteps {
  int per_frame = 1;
  int per_second() const { return per_frame * kFrames; }
  static constexpr int kFrames = 60;
};
FrameSubsteps frame_substeps(const SubstepWindow& window);

/// Lines for the user: the range of rates and why, or why there is none and what to do.
std::vector<std::string> describe_window(const SubstepWindow& window);

}  // namespace springlod::report
