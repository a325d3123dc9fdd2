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
  /// `resist`: false: the corners are watched, and exert no force. `held`: nodes that corners do
  /// not move; null: none. The model must outlive this.
  StepCorners(const MassSpringModel& model, bool resist, const HeldNodes* held = nullptr);

  /// Whether corners exert forces.
  bool resist() const { return resist_; }

  void begin(double step);
  /// Adds a corner if it resists at the start of the step, or at its end as the contacts and the
  /// corners before have left it. A corner that has been added is left as it is. `resisted`: it is
  /// one of resisting() of the last step.
  void check(std::uint32_t number, bool resisted, StepNodes& nodes);

  /// Gives the corners that were added since the last call their forces of the last step, to start
  /// from. Returns whether there are any.
  bool start(StepNodes& nodes);
  /// Updates all corners once. Returns the largest change of a node's position over the largest
  /// displacement of a node by a corner [1].
  double sweep(StepNodes& nodes);
  /// Ends the sweeps: counts the displacements by the corners at their nodes.
  void count(StepNodes& nodes);
  /// Ends the step: the nodes are at their final positions.
  void finish(StepNodes& nodes);

  /// Energy lost to the corners of the step [J], without the part that the forces of the scheme
  /// take: see LedgerEntry.
  double loss() const { return loss_; }
  /// Corners with J < kCornerResists at the end of the step, of those that were checked.
  const std::vector<std::uint32_t>& resisting() const { return resisting_; }
  /// Corners with J <= 0 at the end of the step, of those that were checked.
  const std::vector<std::uint32_t>& inverted() const { return inverted_; }
  /// Corners with J <= 0 at the start of the step that were not checked in the step before: others
  /// pressed them.
  const std::vector<std::uint32_t>& late_inverted() const { return late_inverted_; }
  /// Largest change of a corner that resisted in the step [1]: of kCornerResists - J, where that is
  /// positive, or of J times V0 over the mean of all corners, if that is less than 1. A large
  /// corner that closes fast strains its springs; a small one has little energy until it resists.
  double largest_change() const { return largest_change_; }

 private:
  /// A corner that resists in this step.
  struct Press {
    std::uint32_t corner = 0;
    std::array<std::uint32_t, 4> slot{};
    CornerNodes gradient;              // of J, in the middle of the step without it [1/m]
    std::array<double, 4> mobility{};  // displacement of a node by a unit force, dt^2 / 2m [m/N]
    NormalLaw law;                     // its depth is kCornerResists - J [1]
    double before = 0;                 // depth at the start of the step [1]
    double level = 0;                  // depth = level - sum of gradient . x [1]
    double force = 0;                  // so far [J]
    double counted = 0;                // of it, see count() [J]
    double move = 0;                   // largest displacement of a node by a unit force [m/J]
    double most = 0;                   // largest force [J]
  };
  /// What a corner keeps from step to step.
  struct Kept {
    double inverse_volume = 0;  // 1 / V0 [1/m3]
    double stiffness = 0;       // [J]
    double largest_move = 0;    // of a node in a step [m]
    double weight = 0;          // V0 over the mean of all corners, at most 1 [1]
    double force = 0;           // in the last step; 0 if it did not resist [J]
    bool is_pressed = false;    // in this step
  };

  static double linear_depth(const Press& press, const StepNodes& nodes);
  /// Moves the nodes as the force does.
  static void push(const Press& press, double force, StepNodes& nodes);
  void book(const Press& press, const StepNodes& nodes);
  /// `end`: J at the end of the step.
  void note(std::uint32_t corner, double end);

  const MassSpringModel* model_;
  bool resist_;
  std::vector<Kept> kept_;                     // by corner
  std::vector<double> inverse_mass_;           // by node, 0 if held [1/kg]
  std::vector<std::uint32_t> pressed_before_;  // corners with a force in the last step
  double step_ = 0;                            // [s]
  std::vector<Press> presses_;
  std::size_t started_ = 0;  // of them
  std::vector<std::uint32_t> resisting_, inverted_, late_inverted_;
  double loss_ = 0;
  double largest_change_ = 0;
};

}  // namespace springlod::sim
