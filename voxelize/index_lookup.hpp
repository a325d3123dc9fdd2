#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// No cell or node at this place.
inline constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

/// The order of cells and nodes everywhere: z first, then y, then x.
inline bool grid_order(const CellIndex& l, const CellIndex& r) {
  if (l[2] != r[2]) return l[2] < r[2];
  if (l[1] != r[1]) return l[1] < r[1];
  return l[0] < r[0];
}

/// Where an index stands in a list sorted by grid_order. Refers to the list, which must outlive it.
/// A dense table over the bounding box where that is affordable, else binary search.
class IndexLookup {
 public:
  explicit IndexLookup(const std::vector<CellIndex>& sorted);
  /// Place in the list, or kNoIndex.
  std::uint32_t find(const CellIndex& index) const;

 private:
  const std::vector<CellIndex>& sorted_;
  CellIndex low_{};
  std::array<std::int64_t, 3> size_{};
  std::vector<std::uint32_t> table_;  // empty: search
};

}  // namespace springlod::voxelize
