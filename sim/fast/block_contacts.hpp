#pragma once

#include <cstdint>
#include <vector>

#include "sim/fast/fast_contacts.hpp"

namespace springlod::sim {

/// The contacts of the nodes of one block. The thread that works on the block needs no other data.
/// An obstacle costs nothing while the block's bounds do not touch it.
class BlockContacts final : public FastContacts {
 public:
  /// `numbers`: the contact points of the body that belong to the block; all of them are nodes.
  BlockContacts(const Shared& shared, std::uint32_t block, std::vector<std::uint32_t> numbers);

  void apply(const Step& step) override;
  /// Stores the bounds before the drift.
  void start_drift() { bounds_before_ = body().bounds(block_); }
  /// After the drift to step number n of `length` [s]: checks whether nodes went through a wall.
  /// `before`, `after`: the frame at its ends.
  void end_drift(std::uint64_t n, const MovingFrame& before, const MovingFrame& after,
                 double length);

 private:
  Vec3 velocity_before_kick(std::size_t contact) const override;
  Vec3 velocity_after_kick(std::size_t contact) const override;
  Vec3 velocity(const Contact& contact, const Vec3& of_frame) const;

  void find_contacts(const Step& step);
  void find_contact(const Step& step, std::size_t obstacle, std::uint32_t index);
  void add_friction(const Step& step);

  Place place(std::uint32_t point) const { return body().place(points().number(point)); }

  std::uint32_t block_;
  std::vector<std::uint32_t> numbers_;                  // contact points of the block
  std::vector<std::uint32_t> number_of_;                // by index in the block; or kNone
  std::vector<std::vector<std::uint64_t>> checked_at_;  // by obstacle and index: last step, plus 1
  std::vector<std::uint32_t> found_;                    // scratch: indices
  Vec3 frame_velocity_ = Vec3::Zero();                  // in the last apply(), before the kick
  Vec3 kicked_frame_velocity_ = Vec3::Zero();           // after the kick
  Box3 bounds_before_;
};

}  // namespace springlod::sim
