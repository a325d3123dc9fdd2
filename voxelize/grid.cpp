#include "voxelize/grid.hpp"

#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"
#include "voxelize/index_lookup.hpp"

namespace springlod::voxelize {
namespace {

// Neighbours and corners of a cell must have 32-bit indices too.
constexpr std::int32_t kLargestIndex = 1 << 30;

std::string text_of(const CellIndex& c) {
  return fmt::format("({}, {}, {})", c[0], c[1], c[2]);
}

void validate_cell(const MaterialGrid& grid, std::size_t n) {
  const CellIndex& c = grid.cells[n];
  for (const std::int32_t i : c)
    if (i < -kLargestIndex || i > kLargestIndex)
      throw InputError(fmt::format("grid: cell {} lies more than {} cells from the origin",
                                   text_of(c), kLargestIndex));
  if (n > 0 && grid.cells[n - 1] == c)
    throw InputError(fmt::format("grid: cell {} occurs twice", text_of(c)));
  if (n > 0 && !grid_order(grid.cells[n - 1], c))
    throw InputError(
        fmt::format("grid: cell {} comes after {}; sort the cells by z, then y, then x", text_of(c),
                    text_of(grid.cells[n - 1])));
  if (grid.material[n] >= grid.materials.size())
    throw InputError(fmt::format("grid: cell {} has material number {}, but there are only {}",
                                 text_of(c), grid.material[n], grid.materials.size()));
}

}  // namespace

void validate(const MaterialGrid& grid) {
  if (!(grid.cell > 0) || !std::isfinite(grid.cell))
    throw InputError(fmt::format("grid: the cell's edge is {} m; it must be above 0", grid.cell));
  if (!grid.origin.allFinite()) throw InputError("grid: its origin is not finite");
  if (grid.material.size() != grid.cells.size())
    throw InputError(fmt::format("grid: {} cells, but {} material numbers", grid.cells.size(),
                                 grid.material.size()));
  if (!grid.depth.empty() && grid.depth.size() != grid.cells.size())
    throw InputError(
        fmt::format("grid: {} cells, but {} depths", grid.cells.size(), grid.depth.size()));
  for (const Material& material : grid.materials) validate(material);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) validate_cell(grid, n);
}

}  // namespace springlod::voxelize
