#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/contact/normal_law.hpp"
#include "sim/correction/corner_law.hpp"
#include "sim/correction/step_nodes.hpp"

namespace springlod::sim {

/// The corners of a body in each step of an explicit scheme: section 9 of docs/method.md. Each
/// corner near inversion gets one force for the whole step along the gradient of its J in the
/// middle of the step without it, from the values of J at both ends. See StepCorrection.
class StepCorners {
 public:
  /// `resist`: false: the corners are watched, and exert no force. The model must outlive this.
  StepCorners(const MassSpringModel& model, bool resist);

  void begin(double step);
  /// Adds a corner if it resists at the start of the step, or at its end as the contacts have left
  /// it. `resisted`: it is one of resisting() of the last step.
  void check(std::uint32_t corner, bool resisted, StepNodes& nodes);

  bool empty() const { return presses_.empty(); }
  /// Updates all corners once.
  void sweep(StepNodes& nodes);
  /// Ends the step: the nodes are at their final positions.
  void finish(StepNodes& nodes);

  /// Energy lost to the corners of the step [J], without the part that the forces of the scheme
  /// take: see LedgerEntry.
  double loss() const { return loss_; }
  /// Corners with J < kCornerResists at the end of the step, in the order of the checks.
  const std::vector<std::uint32_t>& resisting() const { return resisting_; }
  /// Corners with J <= 0 at the end of the step, of those that were checked.
  const std::vector<std::uint32_t>& inverted() const { return inverted_; }
  /// Corners with J <= 0 at the start of the step that were not checked in the step before: others
  /// pressed them.
  const std::vector<std::uint32_t>& late_inverted() const { return late_inverted_; }
  /// Largest change of the J of a corner that resisted in the step [1].
  double largest_change() const { return largest_change_; }

 private:
  /// A corner that resists in this step.
  struct Press {
    std::uint32_t corner = 0;
    std::array<std::uint32_t, 4> slot{};
    CornerNodes gradient;              // of J, in the middle of the step without it [1/m]
    std::array<double, 4> mobility{};  // displacement of a node by a unit force, dt^2 / 2m [m/N]
    NormalLaw law;                     // its depth is kCornerResists - J [1]
    double rest_volume = 0;            // [m3]
    double before = 0;                 // depth at the start of the step [1]
    double level = 0;                  // depth = level - sum of gradient . x [1]
    double force = 0;                  // so far [J]
    double largest_move = 0;           // of a node by a unit force [m/J]
  };

  /// The force, at most that which moves a node by kLargestMove sizes of the corner [J].
  static double capped(const Press& press, double force);
  double linear_depth(const Press& press, const StepNodes& nodes) const;
  void book(const Press& press, const StepNodes& nodes);
  /// `end`: J at the end of the step.
  void note(std::uint32_t corner, double end);

  const MassSpringModel* model_;
  bool resist_;
  std::vector<double> rest_volume_;  // [m3]
  double step_ = 0;                  // [s]
  std::vector<Press> presses_;
  std::vector<std::uint32_t> resisting_, inverted_, late_inverted_;
  double loss_ = 0;
  double largest_change_ = 0;
};

}  // namespace springlod::sim
