#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace springlod::sim {

/// Due travel of a corner that has to be looked at in any case [m].
inline constexpr double kDueAtOnce = -std::numeric_limits<double>::infinity();

/// The travel of a body at which a corner with this margin at the travel `now` has to be looked at
/// again [m], never rounded up. `margin` >= 0 may have been rounded once.
inline double due_travel(double now, double margin) {
  constexpr double kRoundDown = 1 - 2 * std::numeric_limits<double>::epsilon();  // for 4 roundings
  return kRoundDown * (now + margin);
}

/// Adds up the travel of a body, tells when corners have to be looked at, and which of them are
/// checked in a step. The margin of a corner is the distance by which its nodes may move, relative
/// to any rigid motion, before it resists. So a corner has to be looked at only when the body has
/// deformed that much since the last time: flight, rolling and rest cost little.
class CornerWatch {
 public:
  /// A body without corners is never looked at.
  explicit CornerWatch(std::uint32_t corner_count)
      : due_(corner_count > 0 ? kDueAtOnce : std::numeric_limits<double>::infinity()),
        found_((corner_count + kBits - 1) / kBits, 0),
        resisted_(found_.size(), 0) {}

  /// Adds the travel of a step: how far a node moved at most, relative to a rigid motion [m].
  /// Returns whether any corner has to be looked at before the corners are checked.
  bool moved(double travel) {
    add(travel);
    return !(travel_ < due_);
  }
  /// The travel of all steps so far, never rounded down [m].
  double travel() const { return travel_; }
  /// Corners without a margin, which a look of this step found.
  void found(const std::vector<std::uint32_t>& corners) {
    for (const std::uint32_t corner : corners) found_[corner / kBits] |= bit(corner);
    any_ = any_ || !corners.empty();
  }
  /// Ends the looks of this step: the least due travel of all corners.
  void looked(double due) { due_ = due; }
  /// Calls check(corner, resisted) for each corner to check in this step: those that resisted at
  /// the end of the last step or were found in this one. `resisted`: at the end of the last step.
  /// In the first step of a run, all of them count as such: a start may have corners near
  /// inversion. The order is that of their numbers: the sweeps depend on it, and must not depend on
  /// the layout.
  template <class Check>
  void check(const Check& check) {
    if (!any_) return;
    for (std::size_t w = 0; w < found_.size(); ++w) {
      for_each_bit(w, found_[w] | resisted_[w], [&](std::uint32_t corner) {
        check(corner, is_first_ || (resisted_[w] & bit(corner)) != 0);
      });
      found_[w] = 0;
    }
  }
  /// Calls check(corner) for those that resisted at the end of the last step, before any look.
  template <class Check>
  void check_resisting(const Check& check) const {
    if (resisting_.empty()) return;
    for (std::size_t w = 0; w < resisted_.size(); ++w) for_each_bit(w, resisted_[w], check);
  }
  /// Ends the step: how far it moved a node beyond moved() at most [m], and the corners that resist
  /// at its end.
  void corrected(double travel, const std::vector<std::uint32_t>& resisting) {
    add(travel);
    is_first_ = false;
    for (const std::uint32_t corner : resisting_) resisted_[corner / kBits] = 0;
    resisting_ = resisting;
    for (const std::uint32_t corner : resisting_) resisted_[corner / kBits] |= bit(corner);
    any_ = !resisting_.empty();
  }

 private:
  static constexpr std::uint32_t kBits = 64;  // of a word

  static std::uint64_t bit(std::uint32_t corner) { return std::uint64_t{1} << corner % kBits; }
  /// Calls take(corner) for the bits of a word.
  template <class Take>
  static void for_each_bit(std::size_t word, std::uint64_t bits, const Take& take) {
    const auto first = static_cast<std::uint32_t>(kBits * word);
    for (; bits != 0; bits &= bits - 1)
      take(first + static_cast<std::uint32_t>(std::countr_zero(bits)));
  }
  void add(double travel) {
    travel_ = std::nextafter(travel_ + travel, std::numeric_limits<double>::infinity());
  }

  double due_;            // travel at which the next corner is due [m]
  double travel_ = 0;     // [m]
  bool is_first_ = true;  // step of the run
  bool any_ = false;      // corner to check
  // Bits of all corners. Unlike lists, they need no sorting.
  std::vector<std::uint64_t> found_, resisted_;
  std::vector<std::uint32_t> resisting_;  // those in resisted_
};

}  // namespace springlod::sim
