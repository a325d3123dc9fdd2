#include "voxelize/grid.hpp"

#include <algorithm>
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

// Farthest place of a point of the surface from the centre of its cell [cells]: in the next one.
constexpr float kFarthestPlace = 1.5F;
constexpr double kUnit = 1e-5;  // largest error of the length of a normal [1]

void validate_surface(const MaterialGrid& grid) {
  for (std::size_t p = 0; p < grid.surface.size(); ++p) {
    const SurfacePoint& point = grid.surface[p];
    const auto require = [&](bool holds, const char* rule) {
      if (!holds) throw InputError(fmt::format("grid: point {} of its surface {}", p + 1, rule));
    };
    require(std::binary_search(grid.cells.begin(), grid.cells.end(), point.cell, grid_order),
            "is in an empty cell");
    double square = 0;
    for (std::size_t d = 0; d < 3; ++d) {
      require(std::abs(point.place[d]) <= kFarthestPlace, "is far outside its cell");
      square += static_cast<double>(point.normal[d]) * point.normal[d];
    }
    require(std::abs(std::sqrt(square) - 1) <= kUnit, "has a normal that is not a unit vector");
    require(std::isfinite(point.area) && point.area > 0, "has an area that is not above 0");
  }
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
  if (!grid.fraction.empty() && grid.fraction.size() != grid.cells.size())
    throw InputError(
        fmt::format("grid: {} cells, but {} fractions", grid.cells.size(), grid.fraction.size()));
  for (const float fraction : grid.fraction)
    if (!(fraction > 0 && fraction <= 1))
      throw InputError(fmt::format(
          "grid: the fraction of a cell is {}; it must be above 0, at most 1", fraction));
  for (const Material& material : grid.materials) validate(material);
  for (std::size_t n = 0; n < grid.cells.size(); ++n) validate_cell(grid, n);
  validate_surface(grid);
}

MaterialGrid whole_cells(const MaterialGrid& grid) {
  constexpr double kHalf = 0.5;
  MaterialGrid whole = grid;
  whole.fraction.clear();
  whole.surface.clear();
  whole.cells.clear();
  whole.material.clear();
  whole.depth.clear();
  for (std::size_t n = 0; n < grid.cells.size(); ++n) {
    if (grid.fraction_of(n) < kHalf) continue;
    whole.cells.push_back(grid.cells[n]);
    whole.material.push_back(grid.material[n]);
    if (!grid.depth.empty()) whole.depth.push_back(grid.depth[n]);
  }
  return whole;
}

double volume(const MaterialGrid& grid) {
  double cells = 0;
  for (std::size_t n = 0; n < grid.cells.size(); ++n) cells += grid.fraction_of(n);
  return cells * grid.cell * grid.cell * grid.cell;
}

}  // namespace springlod::voxelize
