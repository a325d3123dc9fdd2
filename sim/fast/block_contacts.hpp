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

  /// Stores the bounds before the drift.
  void start_drift() { bounds_before_ = body().bounds(block_); }
  /// Also checks whether nodes tunnelled through walls.
  void correct(const Step& step) override;

 private:
  static constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);

  void note_contacts_before();
  void check_nodes(const Step& step, std::uint32_t obstacle);
  void check_node(const Step& step, std::uint32_t obstacle, std::uint32_t index);

  Place place(std::uint32_t point) const { return body().place(points().number(point)); }
  /// Path of a node in the drift [m].
  StepContacts::Path path(const Step& step, Place at) const;

  std::uint32_t block_;
  std::vector<std::uint32_t> numbers_;                  // contact points of the block
  std::vector<std::uint32_t> number_of_;                // by index in the block; or kNone
  std::vector<std::vector<std::uint64_t>> checked_at_;  // by obstacle and index: last step, plus 1
  // Place in the solver's contacts before the step, by obstacle and index; or kNone.
  std::vector<std::vector<std::uint32_t>> before_;
  std::vector<std::uint32_t> found_;  // scratch: indices
  std::vector<Vec3> from_;            // scratch: start of the drift of each point in numbers_
  Box3 bounds_before_;
};

}  // namespace springlod::sim
