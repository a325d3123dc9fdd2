#include "voxelize/index_lookup.hpp"

#include <algorithm>

namespace springlod::voxelize {
namespace {

// A dense table may take 32 * 4 bytes for each entry of the list, or 4 MB, whichever is more: a
// solid fills a good part of its box, and only scattered cells are worth the slower search.
constexpr double kTableEntriesPerItem = 32;
constexpr double kSmallTable = 1 << 20;

}  // namespace

IndexLookup::IndexLookup(const std::vector<CellIndex>& sorted) : sorted_(sorted) {
  if (sorted.empty()) return;
  low_ = sorted.front();
  CellIndex high = low_;
  for (const CellIndex& index : sorted)
    for (int d = 0; d < 3; ++d) {
      low_[d] = std::min(low_[d], index[d]);
      high[d] = std::max(high[d], index[d]);
    }
  double entries = 1;
  for (int d = 0; d < 3; ++d) {
    size_[d] = std::int64_t{high[d]} - low_[d] + 1;
    entries *= static_cast<double>(size_[d]);
  }
  if (entries > std::max(kSmallTable, kTableEntriesPerItem * static_cast<double>(sorted.size())))
    return;
  table_.assign(static_cast<std::size_t>(size_[0] * size_[1] * size_[2]), kNoIndex);
  for (std::size_t n = 0; n < sorted.size(); ++n) {
    const auto [x, y, z] = sorted[n];
    table_[static_cast<std::size_t>(((z - low_[2]) * size_[1] + (y - low_[1])) * size_[0] +
                                    (x - low_[0]))] = static_cast<std::uint32_t>(n);
  }
}

std::uint32_t IndexLookup::find(const CellIndex& index) const {
  if (table_.empty()) {
    const auto at = std::lower_bound(sorted_.begin(), sorted_.end(), index, grid_order);
    if (at == sorted_.end() || *at != index) return kNoIndex;
    return static_cast<std::uint32_t>(at - sorted_.begin());
  }
  std::array<std::int64_t, 3> r{};
  for (int d = 0; d < 3; ++d) {
    r[d] = std::int64_t{index[d]} - low_[d];
    if (r[d] < 0 || r[d] >= size_[d]) return kNoIndex;
  }
  return table_[static_cast<std::size_t>((r[2] * size_[1] + r[1]) * size_[0] + r[0])];
}

}  // namespace springlod::voxelize
