#include "voxelize/bodies.hpp"

#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {

DisjointSets::Numbers bodies_of(const std::vector<CellIndex>& cells) {
  DisjointSets sets(static_cast<std::uint32_t>(cells.size()));
  const IndexLookup lookup(cells);
  for (std::uint32_t n = 0; n < cells.size(); ++n)
    for (std::int32_t z = -1; z <= 0; ++z)
      for (std::int32_t y = -1; y <= 1; ++y)
        for (std::int32_t x = -1; x <= 1; ++x) {
          const CellIndex other{cells[n][0] + x, cells[n][1] + y, cells[n][2] + z};
          if (!grid_order(other, cells[n])) continue;  // from its other end
          if (const std::uint32_t found = lookup.find(other); found != kNoIndex)
            sets.unite(n, found);
        }
  return sets.numbers();
}

}  // namespace springlod::voxelize
