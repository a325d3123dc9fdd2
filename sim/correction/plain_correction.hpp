#pragma once

#include <vector>

#include "sim/correction/corner_watch.hpp"
#include "sim/correction/step_correction.hpp"

namespace springlod::sim {

/// The corrections of a body whose positions are one vector; checks all contact points in every
/// step.
class PlainCorrection {
 public:
  /// Everything must outlive this. `volumes`: whether corners resist.
  PlainCorrection(const MassSpringModel& model, const ContactPoints& points, ContactFinder& finder,
                  std::size_t obstacle_count, bool volumes, const StepCorrection::Holds& holds);

  /// Corrects a step of length `step` [s] from the positions x to `x_next`, with the velocities
  /// `v_next` at its end. The held nodes are where they are at its end, in `x_next` too.
  void correct(double step, const std::vector<Vec3>& x, std::vector<Vec3>& x_next,
               std::vector<Vec3>& v_next);

  StepCorrection& solver() { return solver_; }
  const StepCorrection& solver() const { return solver_; }

 private:
  void check_contacts(const std::vector<Vec3>& x, const std::vector<Vec3>& x_next);
  void correct_corners(double step, const std::vector<Vec3>& x, const std::vector<Vec3>& x_next);
  /// Travel of the step without contacts and corners: see CornerWatch [m].
  double free_travel(double step, const std::vector<Vec3>& x,
                     const std::vector<Vec3>& x_next) const;
  void look(double step, const std::vector<Vec3>& x, const std::vector<Vec3>& x_next);
  void look_at_corners(const std::vector<Vec3>& x);

  const MassSpringModel* model_;
  const ContactPoints* points_;
  std::size_t obstacle_count_;
  StepCorrection solver_;
  CornerWatch watch_;
  std::vector<double> due_;           // travel at which each corner is due [m]
  std::vector<std::uint32_t> found_;  // by the last look
  Vec3 spin_ = Vec3::Zero();          // of the body at the last look [rad/s]
};

}  // namespace springlod::sim
