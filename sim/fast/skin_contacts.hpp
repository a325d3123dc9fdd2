#pragma once

#include <cstdint>
#include <vector>

#include "sim/contact/contact_schedule.hpp"
#include "sim/fast/fast_contacts.hpp"

namespace springlod::sim {

/// The contacts of the points of a skin. A point may depend on nodes of several blocks, so one
/// thread works on all points while the others wait. An obstacle costs nothing while the body is
/// away from it, and nothing for a point that cannot have reached it yet.
class SkinContacts final : public FastContacts {
 public:
  explicit SkinContacts(const Shared& shared);

  /// Also checks whether points tunnelled through walls.
  void correct(const Step& step) override;

 private:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);

  /// The checks of one obstacle.
  struct View {
    ContactSchedule schedule;
    double travel = 0;  // largest travel of a node towards the obstacle, summed over the steps [m]
    std::vector<std::uint64_t> checked_at;  // by point: last step, plus 1
    std::vector<std::uint32_t> before;      // by point: place in the solver's before(), or kNone
  };

  /// Bounds of all points in world axes [m].
  Box3 bounds(const MovingFrame& frame) const;
  bool near_anything(const Box3& swept) const;
  void arrive();
  void add_travel(const Step& step);
  void check_points(const Step& step, std::uint32_t obstacle);
  /// Returns the travel of the body below which the point cannot touch the obstacle [m].
  double check_point(const Step& step, std::uint32_t obstacle, std::uint32_t point);
  void solve_contacts(const Step& step);
  // Start and end of the step.
  const Vec3& node_to(const Step& step, std::uint32_t node);
  Vec3 node_from(const Step& step, std::uint32_t node);
  Vec3 point_to(const Step& step, std::uint32_t point);
  Vec3 point_from(const Step& step, std::uint32_t point);

  std::vector<std::uint32_t> numbers_;  // numbers of all points
  double reach_ = 1;                    // largest reach of a point [1]
  double near_ = 0;                     // bin of the schedules [m]
  Box3 bounds_;                         // at the end of the last step
  bool away_ = true;                    // in the last step
  std::vector<View> views_;             // by obstacle
  std::vector<Vec3> to_;                // of the nodes; at the end of the step ...
  std::vector<std::uint64_t> to_of_;    // ... whose number this is
  std::vector<Vec3> from_;              // scratch: start of the step of each point
};

}  // namespace springlod::sim
