#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sim/correction/padded.hpp"
#include "sim/held/held_nodes.hpp"

namespace springlod::sim {

/// Path of a node or a point over a step without contacts and corners [m].
struct StepPath {
  Vec3 from = Vec3::Zero();
  Vec3 to = Vec3::Zero();
};
struct PaddedPath {
  Padded from = Padded::Zero();
  Padded to = Padded::Zero();
  StepPath path() const { return {from.head<3>(), to.head<3>()}; }
};

/// The paths of the nodes of a body in one step.
class StepPaths {
 public:
  virtual ~StepPaths() = default;
  virtual void read(std::span<const std::uint32_t> nodes, std::span<PaddedPath> paths) const = 0;

 protected:
  StepPaths() = default;
  StepPaths(const StepPaths&) = default;
  StepPaths(StepPaths&&) = default;
};

/// How a correction changes a node at the end of a step. Friction kicks a node at the start of the
/// step and so moves it by step * kick. The force of a contact, a corner or the spring of an anchor
/// is constant over the step and moves it by step * kick / 2. A held node gets the velocity of its
/// path over the step.
struct NodeChange {
  std::uint32_t node = 0;
  Vec3 displacement = Vec3::Zero();  ///< [m]
  Vec3 kick = Vec3::Zero();          ///< change of the velocity [m/s]
  Vec3 by_corners = Vec3::Zero();    ///< displacement by corners [m]
  Vec3 by_spring = Vec3::Zero();     ///< displacement by the spring of an anchor [m]

  /// Displacement by friction in a step of length `step` [m].
  Vec3 by_friction(double step) const { return 2 * displacement - step * kick; }
  /// Displacement by normal forces of contacts, by corners and by springs [m].
  Vec3 by_pressure(double step) const { return step * kick - displacement; }
  /// Displacement by normal forces of contacts [m].
  Vec3 by_contacts(double step) const { return by_pressure(step) - by_corners - by_spring; }
};

/// The nodes that the contacts and corners of a step move, gathered so that the sweeps of the
/// solver touch little memory. Those of the contacts, which are mostly the same in the next step,
/// can keep their slots. Held nodes always have the first slots and are where they are held;
/// nothing may move them. The nodes on springs of anchors always have the next ones.
class StepNodes {
 public:
  /// `held` must outlive this; null: no node is held. `on_springs`: nodes on springs of anchors.
  explicit StepNodes(std::uint32_t node_count, const HeldNodes* held = nullptr,
                     const std::vector<std::uint32_t>& on_springs = {});

  /// Begins a step with the nodes that were kept; held ones are where they have been moved to. The
  /// paths must outlive the step.
  void begin(const StepPaths& paths);
  /// The nodes so far stay in the next steps, with their slots.
  void keep();
  /// No node stays in the next step.
  void keep_none();
  /// Slot of a node, which is added if it is new.
  std::uint32_t slot(std::uint32_t node) {
    const std::uint32_t slot = slot_[node];
    if (slot == kNone) return add(node);
    shared_ = shared_ || !is_held(slot);
    return slot;
  }
  /// Whether a slot was asked for more than once: then its forces depend on each other.
  bool shared() const { return shared_; }

  std::uint32_t count() const { return static_cast<std::uint32_t>(node_.size()); }
  std::uint32_t node(std::uint32_t slot) const { return node_[slot]; }
  bool is_held(std::uint32_t slot) const { return slot < held_count_; }
  std::uint32_t held_count() const { return held_count_; }
  /// Slot of a node by its number among those on springs.
  std::uint32_t slot_on_spring(std::uint32_t number) const { return held_count_ + number; }
  /// The part of its displacement that its spring has made [m].
  void set_by_spring(std::uint32_t number, const Vec3& part) { by_spring_[number] = part; }
  /// Counts an impulse on a held node, which its anchor takes up [N s].
  void absorb(std::uint32_t slot, const Vec3& impulse) { absorbed_[slot] += impulse; }
  /// What the anchors have taken up in this step, by held node [N s].
  const std::vector<Vec3>& absorbed() const { return absorbed_; }
  /// The nodes by slot.
  const std::vector<std::uint32_t>& nodes() const { return node_; }
  bool has(std::uint32_t node) const { return slot_[node] != kNone; }
  /// Path of a node that has a slot, to its position at the end of the step, so far.
  StepPath corrected_path(std::uint32_t node) const {
    const StepPath path = this->path(slot_[node]);
    return {path.from, path.to + displacement(slot_[node])};
  }
  StepPath path(std::uint32_t slot) const { return paths_[slot].path(); }
  /// Position at the end of the step, so far [m].
  Vec3 at(std::uint32_t slot) const { return at_[slot].head<3>(); }
  Vec3 displacement(std::uint32_t slot) const { return (at_[slot] - paths_[slot].to).head<3>(); }
  void move(std::uint32_t slot, const Vec3& displacement) { at_[slot].head<3>() += displacement; }
  /// Largest displacement of a node since the last call in this step [m].
  double take_travel();
  /// Counts a part of the displacement as one by corners.
  void count_by_corner(std::uint32_t slot, const Vec3& part) { corners_[slot] += part; }
  /// The part of the displacement that is counted as one by corners [m].
  const Vec3& by_corners(std::uint32_t slot) const { return corners_[slot]; }

  // By slot, for sums over many of them.
  std::span<const PaddedPath> paths() const { return paths_; }
  std::span<const Padded> all_at() const { return at_; }
  std::span<Padded> all_at() { return at_; }
  /// The displacements by friction, once they are final.
  std::span<const Padded> slides() const { return slide_; }
  std::span<Padded> slides() { return slide_; }

  /// Appends the change of each node in a step of length `step` [s]. That of a held node gives it
  /// the velocity of its displacement over the step.
  void finish(double step, std::vector<NodeChange>& changes) const;

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t add(std::uint32_t node);

  const HeldNodes* held_;
  std::uint32_t held_count_ = 0;
  std::vector<Vec3> by_spring_;  // by node on a spring [m]
  std::vector<Vec3> absorbed_;   // by held node [N s]
  const StepPaths* of_step_ = nullptr;
  bool shared_ = false;
  std::uint32_t kept_ = 0;           // slots that stay in the next step
  bool kept_shared_ = false;         // whether one of these was asked for more than once
  std::vector<std::uint32_t> slot_;  // by node; or kNone
  // By slot.
  std::vector<std::uint32_t> node_;
  std::vector<PaddedPath> paths_;
  std::vector<Padded> at_;     // at the end of the step, so far [m]
  std::vector<Padded> seen_;   // at_ at the last take_travel() [m]
  std::vector<Padded> slide_;  // displacement by friction [m]
  std::vector<Vec3> corners_;  // displacement by corners [m]
};

}  // namespace springlod::sim
