#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

namespace springlod::sim {

/// Decides in which steps all corners of a body have to be looked at, and which of them are checked
/// in a step. The margin of a corner is the distance by which its nodes may move, relative to any
/// rigid motion, before it resists. So nothing has to be looked at until the body has deformed that
/// much: flight, rolling and rest cost nothing.
class CornerWatch {
 public:
  /// A body without corners is never looked at.
  explicit CornerWatch(std::uint32_t corner_count)
      : margin_(corner_count > 0 ? -1 : std::numeric_limits<double>::infinity()),
        state_(corner_count, State::unchecked) {}

  /// Adds the travel of a step: how far a node moved at most, relative to a rigid motion [m].
  /// Returns whether the corners have to be looked at before they are checked.
  bool moved(double travel) {
    travel_ += travel;
    return !(travel_ < margin_);
  }
  /// The result of a look: the corners without a margin, which resist, and the least margin of the
  /// others.
  void looked(const std::vector<std::uint32_t>& found, double least_margin) {
    for (const std::uint32_t corner : checked_) state_[corner] = State::unchecked;
    checked_.clear();
    for (const std::uint32_t corner : resisting_) add(corner, State::resisting);
    for (const std::uint32_t corner : found) add(corner, State::checked);
    std::sort(checked_.begin(), checked_.end());
    margin_ = least_margin;
    travel_ = 0;
  }
  /// Calls check(corner, resisted) for each corner to check in this step: those that resisted at
  /// the last look or were found by it. `resisted`: at the end of the last step. In the first step
  /// of a run, all of them count as such: a start may have corners near inversion. The order is
  /// that of their numbers: the sweeps depend on it, and must not depend on the layout.
  template <class Check>
  void check(const Check& check) const {
    for (const std::uint32_t corner : checked_)
      check(corner, is_first_ || state_[corner] == State::resisting);
  }
  /// Ends the step: how far it moved a node beyond moved() at most [m], and the corners that resist
  /// at its end.
  void corrected(double travel, const std::vector<std::uint32_t>& resisting) {
    travel_ += travel;
    is_first_ = false;
    for (const std::uint32_t corner : resisting_) state_[corner] = State::checked;
    resisting_ = resisting;
    for (const std::uint32_t corner : resisting_) state_[corner] = State::resisting;
  }

 private:
  enum class State : std::uint8_t { unchecked, checked, resisting };

  void add(std::uint32_t corner, State state) {
    if (state_[corner] != State::unchecked) return;
    checked_.push_back(corner);
    state_[corner] = state;
  }

  double margin_;                       // of the corners that are not checked, at the last look [m]
  double travel_ = 0;                   // since then [m]
  bool is_first_ = true;                // step of the run
  std::vector<std::uint32_t> checked_;  // ascending
  std::vector<std::uint32_t> resisting_;  // at the end of the last step; all of them are checked
  std::vector<State> state_;              // by corner
};

}  // namespace springlod::sim
