#include "voxelize/cells/slivers.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "voxelize/cells/inside.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

constexpr std::size_t kBlockCells = 8;

CellIndex moved(CellIndex cell, std::size_t axis, std::int32_t by) {
  cell[axis] += by;
  return cell;
}

// The cells of the 2 x 2 x 2 block whose lowest cell is given; none if one of them is empty.
std::optional<std::array<std::uint32_t, kBlockCells>> block_at(const IndexLookup& lookup,
                                                               const CellIndex& lowest) {
  std::array<std::uint32_t, kBlockCells> block{};
  for (std::size_t n = 0; n < kBlockCells; ++n) {
    const auto bit = [n](unsigned axis) { return static_cast<std::int32_t>((n >> axis) & 1U); };
    block[n] = lookup.find({lowest[0] + bit(0), lowest[1] + bit(1), lowest[2] + bit(2)});
    if (block[n] == kNoIndex) return std::nullopt;
  }
  return block;
}

// Whether each cell is in a filled block.
std::vector<std::uint8_t> thick_cells(const std::vector<CellIndex>& cells,
                                      const IndexLookup& lookup) {
  std::vector<std::uint8_t> thick(cells.size(), 0);
  for (const CellIndex& cell : cells)
    if (const auto block = block_at(lookup, cell))
      for (const std::uint32_t n : *block) thick[n] = 1;
  return thick;
}

bool touches_thick(const CellIndex& cell, const IndexLookup& lookup,
                   const std::vector<std::uint8_t>& thick) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const std::int32_t by : {-1, 1})
      if (const std::uint32_t n = lookup.find(moved(cell, axis, by));
          n != kNoIndex && thick[n] != 0)
        return true;
  return false;
}

// Of the mesh at a cell, along the axes on which both neighbours are empty; none if there is no
// such axis. From the cell to the neighbour on the far side of the mid-surface, the distance from
// the surface changes by the cosine of the angle between axis and normal.
std::optional<double> thickness_at(const CellIndex& cell, const IndexLookup& lookup,
                                   const DistanceField& distance) {
  std::optional<double> least;
  const double here = distance_at(distance, cell);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const CellIndex below = moved(cell, axis, -1);
    const CellIndex above = moved(cell, axis, 1);
    if (lookup.find(below) != kNoIndex || lookup.find(above) != kNoIndex) continue;
    const double low = distance_at(distance, below);
    const double high = distance_at(distance, above);
    const double thick = 2 * (std::max(low, high) - here) - low - high;
    least = std::min(thick, least.value_or(thick));
  }
  return least;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

std::vector<Sliver> find_slivers(const std::vector<CellIndex>& cells,
                                 const std::vector<std::uint16_t>& solid_of,
                                 const DistanceField& distance, double cell) {
  const IndexLookup lookup(cells);
  const std::vector<std::uint8_t> thick = thick_cells(cells, lookup);
  struct Found {
    std::uint64_t cells = 0;
    std::vector<double> thickness;
  };
  std::map<std::uint16_t, Found> found;  // by solid
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (thick[n] != 0 || touches_thick(cells[n], lookup, thick)) continue;
    Found& of_solid = found[solid_of[n]];
    ++of_solid.cells;
    if (const auto measured = thickness_at(cells[n], lookup, distance))
      of_solid.thickness.push_back(*measured);
  }
  std::vector<Sliver> slivers;
  for (auto& [solid, sum] : found)
    slivers.push_back({solid, sum.cells, sum.thickness.empty() ? cell : median(sum.thickness)});
  return slivers;
}

}  // namespace springlod::voxelize
