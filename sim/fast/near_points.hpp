#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/contact/contact_points.hpp"
#include "sim/contact/contact_schedule.hpp"
#include "sim/contact/tunnel_watch.hpp"
#include "sim/correction/step_correction.hpp"
#include "sim/fast/fast_paths.hpp"
#include "sim/fast/passage.hpp"

namespace springlod::sim {

/// Finds the contact points of a fast body that may touch an obstacle in a step. An obstacle costs
/// nothing while the body is away from it, and nothing for a point that cannot have reached it yet.
class NearPoints {
 public:
  /// Data shared with the owner; must outlive this.
  struct Shared {
    const ContactPoints* points;
    const std::vector<Obstacle>* obstacles;
    const FastBody* body;
    ContactFinder* finder;
    TunnelCheck* walls;
  };
  NearPoints(const Shared& shared, const FastPaths& paths);

  /// Checks the points for the drift that the body has just done.
  void check(const FastStep& step, StepCorrection& solver);
  /// Adds what the correction of the step moved a node by at most [m].
  void corrected(double travel);
  /// After the correction: checks whether points tunnelled through walls. `nodes`: those that it
  /// moved.
  void check_walls(const FastStep& step, const StepNodes& nodes);
  /// The first point that tunnelled.
  const std::optional<Passage>& passage() const { return passage_; }

 private:
  /// The checks of one obstacle.
  struct View {
    ContactSchedule schedule;
    double travel = 0;  // largest travel of a node towards the obstacle, summed over the steps [m]
    std::vector<std::uint64_t> checked_at;  // by point: last step, plus 1
    std::vector<std::uint32_t> near;        // points of a box checked in this step
  };

  /// Bounds of all points in world axes [m].
  Box3 bounds(const MovingFrame& frame) const;
  bool near_anything(const Box3& swept) const;
  void arrive();
  void add_travel(const FastStep& step);
  void continue_contacts(const FastStep& step, std::uint32_t obstacle, StepCorrection& solver);
  /// The points that are not in contact.
  void check_points(const FastStep& step, std::uint32_t obstacle, StepCorrection& solver);
  void check_point(const FastStep& step, std::uint32_t obstacle, std::uint32_t point,
                   StepCorrection& solver);
  void note_check(const FastStep& step, std::uint32_t obstacle, std::uint32_t point);
  Vec3 point_to(std::uint32_t point) const;
  StepPath point_path(std::uint32_t point) const;
  StepPath corrected_path(std::uint32_t point, const StepNodes& nodes) const;

  Shared shared_;
  const FastPaths* paths_;
  double reach_ = 1;         // largest reach of a point [1]
  double near_ = 0;          // bin of the schedules [m]
  Box3 bounds_;              // at the end of the last step
  bool away_ = true;         // in the last step
  std::vector<View> views_;  // by obstacle
  std::optional<Passage> passage_;
};

}  // namespace springlod::sim
