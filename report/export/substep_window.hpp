#pragma once

#include <string>
#include <vector>

#include "model/mass_spring.hpp"

namespace springlod::report {

/// Substeps for engines that, in each substep, move the nodes by their velocities and then correct
/// every spring once, one after another, in single precision (XPBD with one iteration; Jolt, and
/// Bullet's position-based solver).
///
/// A spring corrected in the middle of such a sweep is disturbed by the corrections after it, which
/// are half of all in the mean. At rest all corrections together cancel gravity, so that half
/// amounts to a compliance of dt^2 (1/m_a + 1/m_b) / 2 beside 1 / k. The exported files take it off
/// the compliance of each spring. docs/export.md states with measurements what remains:
/// - The order of the corrections: up to kOrderError (frequency dt)^2 of the body's compliance.
/// - Springs whose 1 / k is smaller than that half: they are too soft by the difference.
/// - A substep adds g dt^2 to a position. If that is not large beside the spacing of single
///   precision numbers there, rounding loses a share kRoundingError spacing / (g dt^2) of gravity.
/// The first two bound the rate from below, the third from above.
struct SubstepWindow {
  /// Root of the mean of k (1/m_a + 1/m_b) over the springs, by their energy in uniform stress
  /// [rad/s]: soft materials count more, since they deform more. Below the highest frequency.
  double frequency = 0;
  double from = 0, to = 0;     ///< rates within kWindowError [1/s]; both 0 if there are none
  double rate = 0;             ///< to recommend [1/s]: the least within kGoodError, or the best
  double error = 0;            ///< estimated relative error of the static deformation at `rate` [1]
  double cheap_softening = 1;  ///< deformation over the right one, at 1200 substeps a second

  bool empty() const { return to <= 0; }
};

// Measured on hanging bodies (tests/peers/jolt_rates.mjs): upper ends of what they show.
inline constexpr double kOrderError = 0.1;
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

/// Lines for the user: the error to expect, the range of rates and why, or what to do without one.
std::vector<std::string> describe_window(const SubstepWindow& window);

}  // namespace springlod::report
