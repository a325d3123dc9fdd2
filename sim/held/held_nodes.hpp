#pragma once

#include <cstdint>
#include <vector>

#include "model/mass_spring.hpp"
#include "sim/held/anchor.hpp"
#include "sim/held/rigid_path.hpp"

namespace springlod::sim {

/// When the last of the anchors comes to rest; 0 if none moves [s].
double end_of_paths(const std::vector<Anchor>& anchors);

/// The nodes that the anchors of a run hold, and where they are at each time. A held node has the
/// position and the velocity that its anchor prescribes; forces on it act on the anchor. Each node
/// is named by its index among the held ones.
class HeldNodes {
 public:
  /// Which anchors count: those that hold their nodes, or those that pull them by springs, whose
  /// nodes would be held here.
  enum class By { hand, springs };

  /// `start`: positions of all nodes at the start. Throws InputError: see validate.
  HeldNodes(const MassSpringModel& model, const std::vector<Anchor>& anchors,
            const std::vector<Vec3>& start, By by = By::hand);

  bool empty() const { return node_.empty(); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(node_.size()); }
  /// Node of each of them, anchor by anchor.
  const std::vector<std::uint32_t>& nodes() const { return node_; }
  std::uint32_t node(std::size_t held) const { return node_[held]; }
  std::size_t anchor(std::size_t held) const { return anchor_[held]; }
  /// Whether a node of the model is held.
  bool holds(std::uint32_t node) const { return !is_held_.empty() && is_held_[node] != 0; }

  /// Moves them to where they are at that time [s].
  void move_to(double time);
  /// Positions at the last move_to(), at first those at the start [m].
  const std::vector<Vec3>& at() const { return at_; }
  /// Writes them to the positions of all nodes [m].
  void put(std::vector<Vec3>& x) const;
  /// Writes their velocities at the time of the last move_to() to those of all nodes [m/s].
  void put_velocities(std::vector<Vec3>& v) const;
  /// The pivot of an anchor at the last move_to() [m].
  const Vec3& pivot(std::size_t anchor) const { return pivot_[anchor]; }

 private:
  std::vector<RigidPath> path_;            // by anchor
  std::vector<RigidPath::Pose> pose_;      // by anchor
  std::vector<Vec3> first_pivot_, pivot_;  // by anchor [m]
  std::vector<std::uint8_t> is_held_;      // by node of the model; empty without anchors
  // By held node.
  std::vector<std::uint32_t> node_, anchor_;
  std::vector<Vec3> first_, at_;  // [m]
};

}  // namespace springlod::sim
