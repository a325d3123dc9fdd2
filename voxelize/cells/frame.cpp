#include "voxelize/cells/frame.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/error.hpp"

namespace springlod::voxelize {
namespace {

// Most cells in the bounding box: 2 GB at about 20 bytes per cell. Their lattice would have as many
// nodes and nine times as many springs.
constexpr double kMostCells = 1e8;
// Largest distance from the origin / size of the object. Beyond it, coordinates resolve the object
// with fewer than 10 digits in double precision, and with none in the file's single precision.
constexpr double kFarthest = 1e6;

Vec3 cells_along(const Vec3& sides, double cell) {
  return (sides / cell).array().round().max(1).matrix();
}

double smallest_cell(const Vec3& sides, double cell) {
  constexpr double kStep = 1.01;  // accurate enough for the message
  while (cells_along(sides, cell).prod() > kMostCells) cell *= kStep;
  return cell;
}

}  // namespace

CellFrame frame_around(const Box3& box, double cell) {
  if (!(cell > 0) || !std::isfinite(cell))
    throw InputError(fmt::format("voxelize: cell = {} m must be a length above 0", cell));
  const Vec3 sides = box.isEmpty() ? Vec3(Vec3::Zero()) : Vec3(box.sizes());
  if (!(sides.minCoeff() > 0))
    throw InputError("voxelize: the mesh is flat or empty; it encloses no volume");
  if (std::round(sides.maxCoeff() / cell) < 1)
    throw InputError(
        fmt::format("voxelize: a cell of {:.4g} m is more than twice as long as the whole mesh, "
                    "{:.4g} m; use a smaller cell (or check the unit of the file)",
                    cell, sides.maxCoeff()));
  const double distance =
      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  if (distance > kFarthest * sides.maxCoeff())
    throw InputError(fmt::format(
        "voxelize: the mesh is {:.3g} m across but lies {:.3g} m from the origin; at that distance "
        "coordinates are too inexact; move it closer to the origin",
        sides.maxCoeff(), distance));
  const Vec3 count = cells_along(sides, cell);
  if (count.prod() > kMostCells)
    throw InputError(
        fmt::format("voxelize: cells of {:.4g} m make a grid of {:.3g} cells, the limit is {:.3g}; "
                    "use a cell of {:.4g} m or more (or check for a stray vertex: the mesh is "
                    "{:.4g} x {:.4g} x {:.4g} m)",
                    cell, count.prod(), kMostCells, smallest_cell(sides, cell), sides.x(),
                    sides.y(), sides.z()));
  CellFrame frame;
  frame.cell = cell;
  frame.origin = box.center() - cell * count / 2;
  for (int d = 0; d < 3; ++d) frame.size[d] = static_cast<std::int32_t>(count[d]);
  return frame;
}

CellFrame padded(const CellFrame& frame) {
  return {frame.cell,
          frame.origin - Vec3::Constant(frame.cell),
          {frame.size[0] + 2, frame.size[1] + 2, frame.size[2] + 2}};
}

}  // namespace springlod::voxelize
