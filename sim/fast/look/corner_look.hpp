#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "sim/correction/corner_watch.hpp"

namespace springlod::sim {

/// A look at the corners of a body, see FastBody::find_corners().
struct CornerLook {
  double travel = 0;    ///< of the body so far [m]
  double farthest = 0;  ///< at least the largest absolute coordinate of a node [m]
};

/// The travel at which each group of the corners of a block is due, see FastBody::find_corners().
struct CornerDues {
  /// Dues that are compared at once [1].
  static constexpr std::size_t kTogether = 8;

  explicit CornerDues(std::size_t groups = 0)
      : count(groups),
        travel((groups + kTogether - 1) / kTogether * kTogether,
               std::numeric_limits<double>::infinity()) {
    std::fill_n(travel.begin(), groups, kDueAtOnce);
  }

  std::size_t count;               ///< of groups
  std::vector<double> travel;      ///< by group, padded with infinity [m]
  std::vector<std::uint32_t> now;  ///< groups that the last look looked at, ascending
};

}  // namespace springlod::sim
