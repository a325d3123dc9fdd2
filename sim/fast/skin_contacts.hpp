#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/fast/fast_contacts.hpp"

namespace springlod::sim {

/// The contacts of the points of a skin. A point may depend on nodes of several blocks, so one
/// thread works on all points while the others wait. An obstacle costs nothing while the body does
/// not touch it, and almost nothing for a point that cannot have reached it yet.
class SkinContacts final : public FastContacts {
 public:
  /// The model must outlive this.
  SkinContacts(const Shared& shared, const MassSpringModel& model);

  /// Also checks whether points tunnelled through walls since the last step.
  void apply(const Step& step) override;

 private:
  /// Last check of one obstacle.
  struct View {
    std::optional<std::uint64_t> last;  // step at which it was checked
    std::vector<double> due;  // travel of the body below which each point cannot touch it [m]
  };

  Vec3 velocity_before_kick(std::size_t contact) const override;
  Vec3 velocity_after_kick(std::size_t contact) const override { return after_kick_[contact]; }
  Vec3 kicked_velocity(const Contact& contact, const Step& step) const;

  /// Position and velocity before the kick.
  Motion motion(std::uint32_t point) const;
  /// Bounds of all points in world axes [m].
  Box3 bounds(const MovingFrame& frame) const;
  bool near_anything(const Box3& region) const;
  void arrive(const Step& step, bool near, const Box3& swept);
  void find_contacts(const Step& step, std::size_t obstacle);
  void add_friction(const Step& step);

  const MassSpringModel* model_;
  std::vector<std::uint32_t> numbers_;  // numbers of all points
  double reach_ = 1;                    // largest reach of a point [1]
  std::vector<Vec3> x_, v_;             // of the nodes
  Box3 bounds_;
  std::optional<std::uint64_t> arrived_;   // step number
  double travel_ = 0, travel_before_ = 0;  // sum over the steps of the fastest node's travel [m]
  std::vector<View> views_;                // by obstacle
  std::optional<std::uint64_t> kicked_;    // step number
  std::vector<Contact> contacts_before_;
  std::vector<Vec3> after_kick_;  // velocities of the points in now() [m/s]
};

}  // namespace springlod::sim
