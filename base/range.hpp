#pragma once

#include <limits>
#include <string>

#include "base/units.hpp"

namespace springlod::inline base {

/// The values that an option accepts, both ends included. For text it bounds the length [bytes],
/// for lists each entry.
struct Range {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  /// False for NaN.
  constexpr bool contains(double value) const { return value >= least && value <= most; }
};

/// [bytes]; longer lines of text do not fit into a picture.
inline constexpr double kLongestTitle = 1000;

/// "1 to 100", "1 ms to 10 s".
std::string to_string(const Range& range, Dimension dimension);

}  // namespace springlod::inline base
