#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "voxelize/grid.hpp"

namespace springlod::voxelize {

/// No cell or node at this place.
inline constexpr std::uint32_t kNoIndex = std::numeric_limits<std::uint32_t>::max();

/// The order of cells and nodes: by z, then y, then x.
inline bool grid_order(const CellIndex& l, const CellIndex& r) {
  if (l[2] != r[2]) return l[2] < r[2];
  if (l[1] != r[1]) return l[1] < r[1];
  return l[0] < r[0];
}

/// Finds an index in a list sorted by grid_order: by a dense table over the bounding box if that is
/// small enough, otherwise by binary search. Refers to the list, which must outlive it.
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
