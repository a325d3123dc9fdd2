#pragma once

#include <cstdint>

#include "lod/calibration/error_ratios.hpp"

namespace springlod::lod {

/// State of a BoundSchedule.
struct BoundState {
  double bound = 0;           ///< tau, on the squared frequencies of the nodes [rad2/s2]
  double within = 0;          ///< bound of the last level within tolerance [rad2/s2]; 0: none
  double merit = 0;           ///< F with this bound after the last step
  std::uint32_t steps = 0;    ///< with this bound
  std::uint32_t idle = 0;     ///< last steps that lowered F little
  std::uint32_t refined = 0;  ///< steps since omega_max was low enough
  bool took_back = false;     ///< half of a decrease, after which a level stayed outside
  ErrorRatios slack{1, 1, 1, 1, 1};  ///< factor on the tolerance of each kind of error [1]

  bool operator==(const BoundState&) const = default;
};

/// A level after a step of its fit.
struct SteppedLevel {
  double frequency = 0;   ///< omega_max [rad/s]
  double node_bound = 0;  ///< largest squared node frequency B [rad2/s2]
  double merit = 0;       ///< F with the bound of the step
  ErrorRatios ratios{};   ///< errors over tolerances
};

/// Chooses the bound tau on the node frequencies of a fit (docs/method.md, eqs. 45 and 46). The
/// bound is lowered each time that the level is within tolerance, until omega_max has come down to
/// the wanted one. A level that does not come back within tolerance gets a bound between the last
/// two. A level that was never within tolerance gets as much slack as it needs.
class BoundSchedule {
 public:
  /// `wanted_frequency`: omega_max that need not be lowered further [rad/s].
  explicit BoundSchedule(double wanted_frequency) : wanted_(wanted_frequency) {}

  /// Takes the level after a step and sets the bound of the next one. False if the fit has ended.
  bool next(const SteppedLevel& level);

  bool within_tolerance(const ErrorRatios& ratios) const;
  bool low_enough(double frequency) const { return frequency <= wanted_; }

  BoundState state{};

 private:
  /// Whether the last steps lowered F little.
  bool settled(const SteppedLevel& level);
  void give_slack(const ErrorRatios& ratios);
  void lower(const SteppedLevel& level);
  bool take_back_half();
  void change(double bound);

  double wanted_;
};

}  // namespace springlod::lod
